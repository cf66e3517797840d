/* Kleene's disjunction. */
static unsigned char either(unsigned char a, unsigned char b)
{
    if (a == TRUE || b == TRUE)
        return TRUE;
    return a > b ? a : b;
}
