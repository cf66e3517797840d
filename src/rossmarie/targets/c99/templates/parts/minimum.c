static double minimum(double a, double b) { return isnan(a) || isnan(b) ? NAN : a < b ? a : b; }
