static double pitch_of(double x, double y, double z, double w)
{
    const double n = ((x * x + y * y) + z * z) + w * w;
    const double sine = (2.0 * (w * y - z * x)) / n;
    /* Rounding may leave the range of a sine by an ulp, where asin has no value. */
    return n == 0.0 ? NAN : asin(sine < -1.0 ? -1.0 : sine > 1.0 ? 1.0 : sine);
}
