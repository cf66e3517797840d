/* Kleene's disjunction. */
static unsigned char either(unsigned char a, unsigned char b)
{
    return a == TRUE || b == TRUE ? TRUE : a > b ? a : b;
}
