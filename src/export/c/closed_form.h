/* Loading curve f = F/F_y at w = delta/delta_y, and its slope df/dw:
   f = w^1.5 exp(-q L^3/(b^2 + L^2)), L = max(0, ln(w/w_1)), w_1 LAW_DEPARTURE, b LAW_BREADTH, q LAW_SOFTENING. */
LAW_FUNCTION double law_loading(double w, double *slope)
{
    const double b2 = LAW_BREADTH * LAW_BREADTH;
    double root = sqrt(w), l, l2, inverse, f;
    if (w <= LAW_DEPARTURE) {
        *slope = 1.5 * root;
        return w * root;
    }
    l = log(w / LAW_DEPARTURE);
    l2 = l * l;
    inverse = 1.0 / (b2 + l2);
    f = w * root * exp(-LAW_SOFTENING * l * l2 * inverse);
    *slope = (1.5 - LAW_SOFTENING * l2 * (3.0 * b2 + l2) * inverse * inverse) * f / w;
    return f;
}
