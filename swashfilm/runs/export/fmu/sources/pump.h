/* SPDX-License-Identifier: MIT
 *
 * The pump by its map: tensor product of B-splines over the inputs, each scaled to 0..1 between its ends. What is
 * interpolated are losses: of torque and flows, what they lack of the ideal ones.
 */

#ifndef pump_h
#define pump_h

#define TURN 6.283185307179586

/* A value in the unit that people read. */
static double shown(const Axis *axis, double value)
{
    return axis->factor * value + axis->offset;
}

/* Weights (degree + 1) of the B-splines that are not 0 at a place of an axis; returns the first of them. De Boor's
 * recursion, algorithm A2.2 of Piegl and Tiller, The NURBS Book. */
static size_t weights(const Axis *axis, double place, double weight[])
{
    const double *knot = axis->knots;
    const double x = axis->levels > 1 ? (place - axis->lower) / (axis->upper - axis->lower) : 0.0;
    size_t span = axis->degree;
    while (span + 1 < axis->levels && x >= knot[span + 1])
        ++span;
    weight[0] = 1.0;
    for (size_t j = 1; j <= axis->degree; ++j) {
        double before = 0.0;
        for (size_t r = 0; r < j; ++r) {
            const double left = knot[span + 1 + r - j], right = knot[span + 1 + r];
            const double part = weight[r] / (right - left);
            weight[r] = before + (right - x) * part;
            before = (x - left) * part;
        }
        weight[j] = before;
    }
    return span - axis->degree;
}

/* Add to the channels the coefficients from axis k on, the last axis changing first, times a factor. */
static void add(size_t k, size_t row, double factor, const size_t first[], double weight[][MOST_WEIGHTS],
                double found[])
{
    if (k == INPUTS) {
        for (size_t c = 0; c < CHANNELS; ++c)
            found[c] += factor * COEFFICIENTS[row][c];
        return;
    }
    for (size_t j = 0; j <= AXIS[k].degree; ++j)
        add(k + 1, row * AXIS[k].levels + first[k] + j, factor * weight[k][j], first, weight, found);
}

/* Outputs at a place inside the map, SI. */
static void pump(const double place[INPUTS], double output[OUTPUTS])
{
    double weight[INPUTS][MOST_WEIGHTS], found[CHANNELS] = {0.0};
    size_t first[INPUTS];
    for (size_t k = 0; k < INPUTS; ++k)
        first[k] = weights(&AXIS[k], place[k], weight[k]);
    add(0, 0, 1.0, first, weight, found);

    const double speed = place[SHAFT_SPEED], volume = found[GEOMETRIC_DISPLACEMENT];
    const double delivery = found[PORT_DELIVERY_PRESSURE], inlet = found[PORT_INLET_PRESSURE];
    memcpy(output, found, OVERALL_EFFICIENCY * sizeof *output);
    output[SHAFT_TORQUE] += volume * (delivery - inlet) / TURN;
    output[DELIVERY_FLOW] += volume * speed / TURN;
    output[INLET_FLOW] += volume * speed / TURN;

    const double useful = delivery * output[DELIVERY_FLOW] - inlet * output[INLET_FLOW];
    const double shaft = speed * output[SHAFT_TORQUE];
    const bool pumps = output[DELIVERY_FLOW] > 0.0 && output[INLET_FLOW] > 0.0 && shaft > 0.0;
    output[OVERALL_EFFICIENCY] = pumps ? useful / shaft : 0.0;
}

#endif
