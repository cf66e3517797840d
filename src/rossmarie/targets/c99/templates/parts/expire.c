/* An input reached its timeout: what it brought is forgotten. */
static void expire(monitor *m, unsigned input)
{
    m->state[input] = EXPIRED;
    m->quiet[input_channel[input]] = false;
    for (unsigned i = input_values[input]; i != input_values[input + 1]; i++)
        m->value[lost_values[i]] = NAN;
}
