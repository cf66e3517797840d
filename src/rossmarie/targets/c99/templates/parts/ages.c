/* How long ago the last message of an input was. */
static void look_at_age(monitor *m, unsigned k, int64_t t_ns)
{
    const unsigned input = age_input[k];
    const bool is_known = m->state[input] != NEVER_RECEIVED;
    const int64_t due_ns = m->stamp_ns[input] + age_limits[k];
    unsigned char value = age_unknown[k];
    if (is_known)
        value = t_ns >= due_ns ? TRUE : FALSE;
    if (value == TRUE)
        m->quiet[input_channel[input]] = false;
    if (value == FALSE)
        wake_by(m, due_ns);
    set_truth(m, age_leaf[k], value, t_ns);
}
