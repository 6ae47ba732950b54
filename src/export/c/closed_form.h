/* Loading curve f = F/F_y at w = delta/delta_y, and its slope df/dw:
   f = w^1.5 exp(-q L^3/(b^2 + L^2)), L = max(0, ln(w/w_1)), w_1 LAW_DEPARTURE, b LAW_BREADTH, q LAW_SOFTENING. */
LAW_FUNCTION double law_loading(double w, double *slope)
{
    double root = sqrt(w), l, l2, v, f;
    if (w <= LAW_DEPARTURE) {
        *slope = 1.5 * root;
        return w * root;
    }
    l = log(w / LAW_DEPARTURE);
    l2 = l * l;
    f = w * root * exp(-LAW_SOFTENING * l * l2 / (LAW_BREADTH * LAW_BREADTH + l2));
    v = l2 / (LAW_BREADTH * LAW_BREADTH);
    *slope = (1.5 - LAW_SOFTENING * v * (3.0 + v) / ((1.0 + v) * (1.0 + v))) * f / w;
    return f;
}
