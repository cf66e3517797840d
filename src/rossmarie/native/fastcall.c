/* A Python function for one channel of a monitor: (at_ns, *numbers) -> number of new events.
 *
 * Compiled together with host.c where the headers of Python are at hand; it is several times as fast
 * as a call through a foreign function interface.
 */
#define PY_SSIZE_T_CLEAN
#include <Python.h>

#include "host.c"

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
    if (count != to->fields + 1)
        return PyErr_Format(PyExc_TypeError, "wanted an instant and %d number(s)", to->fields);
    t_ns = PyLong_AsLongLong(arguments[0]);
    if (t_ns == -1 && PyErr_Occurred())
        return NULL;
    for (int i = 0; i < to->fields; i++) {
        values[i] = PyFloat_AsDouble(arguments[i + 1]);
        if (values[i] == -1.0 && PyErr_Occurred())
            return NULL;
    }
    return PyLong_FromLong(host_packed(to->machine, to->channel, t_ns, values));
}

static PyMethodDef definition = {
    "update", (PyCFunction)(void (*)(void))fastcall, METH_FASTCALL,
    "One message: (at_ns, *numbers) -> number of new events, or -1 if the instant is out of range."};

static void forget(PyObject *capsule)
{
    target *to = (target *)PyCapsule_GetPointer(capsule, NULL);
    Py_DECREF(to->owner);
    PyMem_Free(to);
}

/* The function for a channel; NULL with an exception if there is no memory. */
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
