/* Python functions for a guard: the functions of fastcall.c, after which the reactor runs, and a
 * function for a step.
 *
 * This file is compiled together with guarding.c if the headers of Python are installed.
 */
#define PY_SSIZE_T_CLEAN
#include <Python.h>

#include "guarding.c"

#define TAKE_PACKED guard_packed
#include "fastcall.c"

typedef struct stepper {
    host *machine;
    PyObject *owner; /* keeps the machine and the wiring alive */
    const guard_wiring *wiring;
    double *observation; /* room for the conversion of float32 numbers */
    double *action;
} stepper;

/* Returns the numbers of a one-dimensional array: its own memory if the numbers are float64, or a
 * copy in `room` if they are float32. Returns NULL if the length is different or the elements are
 * not floats. Release `view` if its member obj is not NULL.
 */
static double *numbers_of(PyObject *array, size_t length, double *room, Py_buffer *view, int flags)
{
    if (PyObject_GetBuffer(array, view, flags | PyBUF_C_CONTIGUOUS | PyBUF_FORMAT) != 0) {
        PyErr_Clear();
        view->obj = NULL;
        return NULL;
    }
    if (view->ndim != 1 || (size_t)view->shape[0] != length || !view->format || view->format[1])
        return NULL;
    if (view->format[0] == 'd')
        return (double *)view->buf;
    if (view->format[0] != 'f')
        return NULL;
    for (size_t i = 0; i != length; i++)
        room[i] = ((const float *)view->buf)[i];
    return room;
}

/* Writes changed numbers back into their array. A float32 number is rounded towards 0. */
static void put_back(const double *numbers, const Py_buffer *view)
{
    float *floats = (float *)view->buf;
    if (view->format[0] != 'f')
        return;
    for (Py_ssize_t i = 0; i != view->shape[0]; i++) {
        const float nearest = (float)numbers[i];
        const bool is_beyond = fabs((double)nearest) > fabs(numbers[i]);
        floats[i] = is_beyond ? nextafterf(nearest, 0.0f) : nearest;
    }
}

/* Returns the result of a step as bytes: the bits of the step, the active rules, the margins and,
 * if the action was changed, the states of the tasks with their instants.
 */
static PyObject *noted(const host *h, int said)
{
    const size_t rules = sizeof h->machine.active;
    const size_t tasks = said & GUARD_CHANGED ? GUARD_TASKS : 0;
    const size_t size = 1 + rules + sizeof(double) * GUARD_MARGINS + 9 * tasks;
    double margins[GUARD_MARGINS + 1];
    PyObject *note = PyBytes_FromStringAndSize(NULL, (Py_ssize_t)size);
    unsigned char *to;
    if (!note)
        return NULL;
    to = (unsigned char *)PyBytes_AS_STRING(note);
    *to++ = (unsigned char)said;
    memcpy(to, h->machine.active, rules);
    to += rules;
    guard_margins(h, margins);
    memcpy(to, margins, sizeof(double) * GUARD_MARGINS);
    to += sizeof(double) * GUARD_MARGINS;
    if (tasks) {
        int64_t since_ns[GUARD_TASKS + 1];
        guard_note(h, to, since_ns);
        memcpy(to + tasks, since_ns, 8 * tasks);
    }
    return note;
}

/* (at_ns, observation or None, action or None) -> the result of the step, or None if the arrays or
 * the instant do not fit. Then the guard has not changed.
 */
static PyObject *faststep(PyObject *self, PyObject *const *arguments, Py_ssize_t count)
{
    stepper *by = (stepper *)PyCapsule_GetPointer(self, NULL);
    Py_buffer seen = {0}, done = {0};
    const double *observation = NULL;
    double *action = NULL;
    bool fits = true;
    int said = -1;
    long long t_ns;
    if (count != 3)
        return PyErr_Format(PyExc_TypeError, "expected an instant, an observation and an action");
    t_ns = PyLong_AsLongLong(arguments[0]);
    if (t_ns == -1 && PyErr_Occurred()) {
        if (!PyErr_ExceptionMatches(PyExc_OverflowError))
            return NULL;
        PyErr_Clear();
        Py_RETURN_NONE;
    }
    if (arguments[1] != Py_None) {
        observation = numbers_of(arguments[1], by->wiring->observed, by->observation, &seen, 0);
        fits = observation != NULL;
    }
    if (fits && arguments[2] != Py_None) {
        action = numbers_of(arguments[2], by->wiring->acted, by->action, &done, PyBUF_WRITABLE);
        fits = action != NULL;
    }
    if (fits) {
        said = guard_step(by->machine, by->wiring, t_ns, observation, action);
        if (action && said >= 0 && said & GUARD_CHANGED)
            put_back(action, &done);
    }
    if (seen.obj)
        PyBuffer_Release(&seen);
    if (done.obj)
        PyBuffer_Release(&done);
    if (host_failed(by->machine))
        return PyErr_NoMemory();
    if (said < 0)
        Py_RETURN_NONE;
    return noted(by->machine, said);
}

/* --- messages ------------------------------------------------------------------------------ */

/* A channel: the slots and arrays of the machine that its messages fill, and room for them. */
typedef struct watcher {
    host *machine;
    PyObject *owner; /* keeps the machine alive */
    int channel;
    int fields;
    int array_count;
    int first_array; /* the arrays of a channel are adjacent */
    const int *slots;
    unsigned char *present;
    double *slot_room;
    const double **arrays;
    size_t *counts;
    Py_buffer *views;
    double **rooms; /* for the conversion of float32 numbers */
} watcher;

/* Returns the elements of a one-dimensional array: its own memory if the elements are float64, or a
 * copy if they are float32. Returns NULL with an exception if the elements are not floats.
 */
static const double *elements_of(PyObject *array, Py_buffer *view, double **room)
{
    if (PyObject_GetBuffer(array, view, PyBUF_C_CONTIGUOUS | PyBUF_FORMAT) != 0)
        return NULL;
    if (view->ndim == 1 && view->format && !view->format[1]) {
        if (view->format[0] == 'd')
            return (const double *)view->buf;
        if (view->format[0] == 'f') {
            const size_t count = (size_t)view->shape[0];
            double *numbers = (double *)PyMem_Realloc(*room, (count + 1) * sizeof **room);
            if (!numbers)
                return (const double *)PyErr_NoMemory();
            for (size_t i = 0; i != count; i++)
                numbers[i] = ((const float *)view->buf)[i];
            *room = numbers;
            return numbers;
        }
    }
    PyErr_SetString(PyExc_TypeError, "an array must have one dimension and contain floats");
    return NULL;
}

/* Processes a message with arrays, and runs the reactor. Returns the number of new events and task
 * commands. The result is negative if the instant is out of range, or with an exception.
 */
static int take_arrays(const watcher *by, int64_t t_ns, const double *values,
                       PyObject *const *arrays)
{
    host *h = by->machine;
    const size_t before = h->count + guard_of(h)->count;
    int done = 0, taken = -1;
    for (int i = 0; i != by->fields; i++)
        by->slot_room[by->slots[i]] = values[i];
    while (done != by->array_count) {
        Py_buffer *view = &by->views[done];
        const double *found = elements_of(arrays[done], view, &by->rooms[done]);
        if (!found)
            break;
        by->arrays[by->first_array + done] = found;
        by->counts[by->first_array + done] = (size_t)view->shape[0];
        done++;
    }
    if (done == by->array_count)
        taken = host_step(h, t_ns, by->present, by->slot_room, by->arrays, by->counts);
    for (int i = 0; i != by->array_count; i++) {
        if (by->views[i].obj)
            PyBuffer_Release(&by->views[i]);
    }
    if (taken < 0)
        return -1;
    guard_follow(h, t_ns);
    return (int)(h->count + guard_of(h)->count - before);
}

/* (at_ns, *numbers, *arrays) -> the instant of the next advance in ns, or None if there are new
 * events or task commands.
 */
static PyObject *fastwatch(PyObject *self, PyObject *const *arguments, Py_ssize_t count)
{
    const watcher *by = (const watcher *)PyCapsule_GetPointer(self, NULL);
    double values[MOST_FIELDS];
    long long t_ns;
    int news;
    if (count != 1 + by->fields + by->array_count)
        return PyErr_Format(PyExc_TypeError, "expected an instant, %d number(s) and %d array(s)",
                            by->fields, by->array_count);
    t_ns = PyLong_AsLongLong(arguments[0]);
    if (t_ns == -1 && PyErr_Occurred())
        return NULL;
    for (int i = 0; i < by->fields; i++) {
        values[i] = PyFloat_AsDouble(arguments[i + 1]);
        if (values[i] == -1.0 && PyErr_Occurred())
            return NULL;
    }
    if (by->array_count)
        news = take_arrays(by, t_ns, values, arguments + 1 + by->fields);
    else
        news = guard_packed(by->machine, by->channel, t_ns, values);
    if (host_failed(by->machine))
        return PyErr_NoMemory();
    if (news < 0) {
        if (!PyErr_Occurred())
            PyErr_Format(PyExc_ValueError, "an instant of %lld ns is out of range", t_ns);
        return NULL;
    }
    if (news)
        Py_RETURN_NONE;
    return PyLong_FromLongLong(guard_next_wake(by->machine));
}

static PyMethodDef watch_definition = {"watch", (PyCFunction)(void (*)(void))fastwatch,
                                       METH_FASTCALL,
                                       "Process a message: (at_ns, *numbers, *arrays) -> the next "
                                       "wake in ns, or None after a new event."};

static void free_watcher(watcher *by)
{
    for (int i = 0; by->rooms && i != by->array_count; i++)
        PyMem_Free(by->rooms[i]);
    PyMem_Free(by->rooms);
    PyMem_Free(by->views);
    PyMem_Free(by->counts);
    PyMem_Free((void *)by->arrays);
    PyMem_Free(by->slot_room);
    PyMem_Free(by->present);
    Py_DECREF(by->owner);
    PyMem_Free(by);
}

static void forget_watcher(PyObject *capsule)
{
    free_watcher((watcher *)PyCapsule_GetPointer(capsule, NULL));
}

/* Returns the function for a channel, or NULL with an exception if there is not enough memory.
 * `owner` must keep `machine` and `shape` alive. `shape` has these numbers, in this order:
 * - the channel, the number of its slots, the number of its arrays, and its first array;
 * - the numbers of channels, slots and arrays of the machine;
 * - the slots of the channel.
 */
PyObject *guard_python_watch(void *machine, const int *shape, PyObject *owner)
{
    PyObject *capsule, *function;
    watcher *by = (watcher *)PyMem_Calloc(1, sizeof *by);
    if (!by)
        return PyErr_NoMemory();
    by->machine = (host *)machine;
    by->owner = owner;
    Py_INCREF(owner);
    by->channel = shape[0];
    by->fields = shape[1];
    by->array_count = shape[2];
    by->first_array = shape[3];
    by->slots = shape + 7;
    by->present = (unsigned char *)PyMem_Calloc((size_t)shape[4] + 1, 1);
    by->slot_room = (double *)PyMem_Calloc((size_t)shape[5] + 1, sizeof(double));
    by->arrays = (const double **)PyMem_Calloc((size_t)shape[6] + 1, sizeof(double *));
    by->counts = (size_t *)PyMem_Calloc((size_t)shape[6] + 1, sizeof(size_t));
    by->views = (Py_buffer *)PyMem_Calloc((size_t)by->array_count + 1, sizeof(Py_buffer));
    by->rooms = (double **)PyMem_Calloc((size_t)by->array_count + 1, sizeof(double *));
    if (!by->present || !by->slot_room || !by->arrays || !by->counts || !by->views || !by->rooms) {
        free_watcher(by);
        return PyErr_NoMemory();
    }
    by->present[by->channel] = 1;
    capsule = PyCapsule_New(by, NULL, forget_watcher);
    if (!capsule) {
        free_watcher(by);
        return NULL;
    }
    function = PyCFunction_NewEx(&watch_definition, capsule, NULL);
    Py_DECREF(capsule);
    return function;
}

/* --- steps --------------------------------------------------------------------------------- */

static PyMethodDef step_definition = {
    "step", (PyCFunction)(void (*)(void))faststep, METH_FASTCALL,
    "Do a step: (at_ns, observation, action) -> its facts, or None if they do not fit."};

static void forget_stepper(PyObject *capsule)
{
    stepper *by = (stepper *)PyCapsule_GetPointer(capsule, NULL);
    Py_DECREF(by->owner);
    PyMem_Free(by->observation);
    PyMem_Free(by->action);
    PyMem_Free(by);
}

/* Returns the function for a guard, or NULL with an exception if there is not enough memory. */
PyObject *guard_python_step(void *machine, void *wiring, PyObject *owner)
{
    PyObject *capsule, *function;
    stepper *by = (stepper *)PyMem_Calloc(1, sizeof *by);
    if (!by)
        return PyErr_NoMemory();
    by->machine = (host *)machine;
    by->wiring = (const guard_wiring *)wiring;
    by->owner = owner;
    Py_INCREF(owner);
    by->observation = (double *)PyMem_Calloc(by->wiring->observed + 1, sizeof(double));
    by->action = (double *)PyMem_Calloc(by->wiring->acted + 1, sizeof(double));
    capsule = by->observation && by->action ? PyCapsule_New(by, NULL, forget_stepper) : NULL;
    if (!capsule) {
        Py_DECREF(owner);
        PyMem_Free(by->observation);
        PyMem_Free(by->action);
        PyMem_Free(by);
        return PyErr_Occurred() ? NULL : PyErr_NoMemory();
    }
    function = PyCFunction_NewEx(&step_definition, capsule, NULL);
    Py_DECREF(capsule);
    return function;
}
