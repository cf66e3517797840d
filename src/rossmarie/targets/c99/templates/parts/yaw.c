static double yaw_of(double x, double y, double z, double w)
{
    const double n = ((x * x + y * y) + z * z) + w * w;
    const double sine = (2.0 * (w * z + x * y)) / n;
    const double cosine = 1.0 - (2.0 * (y * y + z * z)) / n;
    return n == 0.0 ? NAN : atan2(sine, cosine);
}
