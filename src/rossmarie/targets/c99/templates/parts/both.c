/* Kleene's conjunction. */
static unsigned char both(unsigned char a, unsigned char b)
{
    if (a == FALSE || b == FALSE)
        return FALSE;
    return a > b ? a : b;
}
