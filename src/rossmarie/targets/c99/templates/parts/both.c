/* Kleene's conjunction. */
static unsigned char both(unsigned char a, unsigned char b)
{
    return a == FALSE || b == FALSE ? FALSE : a > b ? a : b;
}
