/* A truth about one element of an array. */
static unsigned char element_truth(bool is_unknown, bool value)
{
    return is_unknown ? UNKNOWN : value ? TRUE : FALSE;
}
