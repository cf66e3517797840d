/* Python functions for a monitor: one function processes a message on a channel, the other
 * processes rows of columns.
 *
 * This file is compiled together with batch.c if the headers of Python are installed. Its functions
 * are several times as fast as calls through a foreign function interface.
 */
#define PY_SSIZE_T_CLEAN
#include <Python.h>

#include "batch.c"

/* The function that processes a message. Another file can define another function, for an object
 * that contains a monitor.
 */
#ifndef TAKE_PACKED
#define TAKE_PACKED host_packed
#endif

enum { MOST_FIELDS = 256 };

typedef struct target {
    host *machine;
    PyObject *owner; /* keeps the machine alive */
    int channel;
    int fields;
} target;

static PyObject *fastcall(PyObject *self, PyObject *const *arguments, Py_ssize_t count)
{
    const target *to = (const target *)PyCapsule_GetPointer(self, NULL);
    double values[MOST_FIELDS];
    long long t_ns;
    int events;
    if (count != to->fields + 1)
        return PyErr_Format(PyExc_TypeError, "expected an instant and %d number(s)", to->fields);
    t_ns = PyLong_AsLongLong(arguments[0]);
    if (t_ns == -1 && PyErr_Occurred())
        return NULL;
    for (int i = 0; i < to->fields; i++) {
        values[i] = PyFloat_AsDouble(arguments[i + 1]);
        if (values[i] == -1.0 && PyErr_Occurred())
            return NULL;
    }
    events = TAKE_PACKED(to->machine, to->channel, t_ns, values);
    if (host_failed(to->machine))
        return PyErr_NoMemory();
    return PyLong_FromLong(events);
}

static PyMethodDef definition = {
    "update", (PyCFunction)(void (*)(void))fastcall, METH_FASTCALL,
    "Process a message: (at_ns, *numbers) -> number of events, or -1 if at_ns is out of range."};

static void forget(PyObject *capsule)
{
    target *to = (target *)PyCapsule_GetPointer(capsule, NULL);
    Py_DECREF(to->owner);
    PyMem_Free(to);
}

/* Returns the function for a channel, or NULL with an exception if there is not enough memory. */
PyObject *host_python_function(void *machine, int channel, int fields, PyObject *owner)
{
    PyObject *capsule, *function;
    target *to = (target *)PyMem_Malloc(sizeof *to);
    if (!to)
        return PyErr_NoMemory();
    to->machine = (host *)machine;
    to->owner = owner;
    to->channel = channel;
    to->fields = fields;
    capsule = PyCapsule_New(to, NULL, forget);
    if (!capsule) {
        PyMem_Free(to);
        return NULL;
    }
    Py_INCREF(owner);
    function = PyCFunction_NewEx(&definition, capsule, NULL);
    Py_DECREF(capsule);
    return function;
}

/* --- rows of columns ----------------------------------------------------------------------- */

typedef struct rows {
    host *machine;
    PyObject *owner; /* keeps the machine and the table alive */
    const host_table *table;
} rows;

/* Returns the events after the first `before` events, as bytes, and removes them from the log. */
static PyObject *new_events(host *h, size_t before)
{
    const size_t size = host_event_size();
    const char *log = (const char *)h->events;
    PyObject *found = PyBytes_FromStringAndSize(h->count == before ? NULL : log + before * size,
                                                (Py_ssize_t)((h->count - before) * size));
    h->count = before;
    return found;
}

/* (start, stop, memory for active bits or None) -> the events of these rows, as bytes. */
static PyObject *fastrows(PyObject *self, PyObject *const *arguments, Py_ssize_t count)
{
    const rows *of = (const rows *)PyCapsule_GetPointer(self, NULL);
    const size_t before = of->machine->count;
    Py_buffer room = {0};
    size_t start, stop, done;
    if (count != 3)
        return PyErr_Format(PyExc_TypeError,
                            "expected start, stop, and a buffer for active bits or None");
    start = PyLong_AsSize_t(arguments[0]);
    stop = PyLong_AsSize_t(arguments[1]);
    if (PyErr_Occurred())
        return NULL;
    if (arguments[2] != Py_None && PyObject_GetBuffer(arguments[2], &room, PyBUF_WRITABLE) != 0)
        return NULL;
    done = host_run(of->machine, start, stop, of->table, (unsigned char *)room.buf);
    if (room.obj)
        PyBuffer_Release(&room);
    if (host_failed(of->machine))
        return PyErr_NoMemory();
    if (done != stop) {
        return PyErr_Format(PyExc_ValueError, "the instant of row %zu is out of range", done);
    }
    return new_events(of->machine, before);
}

static PyMethodDef rows_definition = {
    "rows", (PyCFunction)(void (*)(void))fastrows, METH_FASTCALL,
    "Process rows: (start, stop, buffer for active bits or None) -> events as bytes."};

static void forget_rows(PyObject *capsule)
{
    rows *of = (rows *)PyCapsule_GetPointer(capsule, NULL);
    Py_DECREF(of->owner);
    PyMem_Free(of);
}

/* Returns the function for a table, or NULL with an exception if there is not enough memory. */
PyObject *host_python_rows(void *machine, void *table, PyObject *owner)
{
    PyObject *capsule, *function;
    rows *of = (rows *)PyMem_Malloc(sizeof *of);
    if (!of)
        return PyErr_NoMemory();
    of->machine = (host *)machine;
    of->owner = owner;
    of->table = (const host_table *)table;
    capsule = PyCapsule_New(of, NULL, forget_rows);
    if (!capsule) {
        PyMem_Free(of);
        return NULL;
    }
    Py_INCREF(owner);
    function = PyCFunction_NewEx(&rows_definition, capsule, NULL);
    Py_DECREF(capsule);
    return function;
}
