/* Kleene's negation. */
static unsigned char opposite(unsigned char a)
{
    if (a == FALSE)
        return TRUE;
    return a == TRUE ? (unsigned char)FALSE : a;
}
