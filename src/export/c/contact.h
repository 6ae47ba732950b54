/* Contact of grains under the law `@NAME@`: friction, rolling resistance and damping around the normal force.
 *
 * Everything is written for a first body and a second one: the unit normal points from the second to the first, forces
 * and moments act on the first. The velocities are those half a step before the positions, as a leapfrog or velocity
 * Verlet scheme has them when forces are due. Slip, rolling and approach are seen along the normal of that time, and what
 * springs hold turns with the normal; a surface is taken to be flat there.
 *
 * damping   F_d = 2 zeta sqrt(m (k + F/z)/2) v, k = dF/d(overlap) and F/z tangent and secant stiffness of the law (z: the
 *           overlap since its force was zero), m the effective mass; the sum with the law's force never pulls. With
 *           -ln e = 2 zeta arccos(zeta)/sqrt(1 - zeta^2) an elastic contact has the restitution e at every speed; a law that
 *           yields loses more. On the tangential spring 2 sqrt(5/6) min(zeta, 1) sqrt(m k_t).
 * friction  Mindlin's spring k_t = 8 G/(2 - nu)/s a (s = 1 on a rigid surface, 2 between grains of the law's material;
 *           a: contact radius) that slides at mu F. While the stiffness grows the load stays, while it falls the load
 *           falls with it: a spring that kept its stretch would give back more than it was given.
 * rolling   spring k_t R_e^2 across the normal that slides at mu_r R_e F, R_e = R_1 R_2/(R_1 + R_2).
 */
#ifndef LAW_CONTACT_H
#define LAW_CONTACT_H

#include <math.h>
#include "@NAME@.h"

/* 8 G/(2 - nu) of the law's material, Pa. */
#define LAW_SHEAR @SHEAR@

/* Effects beside the normal law; 0: there is none. damping: the ratio zeta. */
typedef struct {
    double friction, rolling, damping;
} law_effects;

/* A spring that slides: what it carries (N or N m, on the first body) and how stiff it is. All 0: no contact. */
typedef struct {
    double load[3], stiffness;
} law_slider;

/* What the damping has learned (m/s) of everything else that pushes the bodies, and whether they touched. All 0: no contact. */
typedef struct {
    double others, touched;
} law_dashpot;

/* Two bodies that overlap, SI units. */
typedef struct {
    double normal[3];     /* from the second body to the first */
    double velocity[3];   /* of the first centre relative to the second, or to the surface at the point of contact */
    double spins[2][3];   /* angular velocities; of a surface: 0, its turning is in `velocity` */
    double radii[2];      /* of a surface: 0 */
    double mass;          /* effective */
    double dt;
} law_meeting;

/* Force and moments on the bodies. */
typedef struct {
    double force[3];      /* on the first; the second gets the opposite */
    double torque[2][3];
    double normal_force;
} law_push;

static inline double law_dot(const double *a, const double *b)
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static inline void law_cross(const double *a, const double *b, double *c)
{
    c[0] = a[1] * b[2] - a[2] * b[1];
    c[1] = a[2] * b[0] - a[0] * b[2];
    c[2] = a[0] * b[1] - a[1] * b[0];
}

/* -ln e of an impact with the damping ratio zeta. */
static inline double law_decrement(double ratio)
{
    const double root = sqrt(fabs((1.0 - ratio) * (1.0 + ratio)));
    if (root == 0.0) return 2.0;
    return 2.0 * ratio * (ratio < 1.0 ? atan2(root, ratio) : asinh(root)) / root;
}

/* The damping ratio zeta of a restitution e in (0, 1]; by bisection, so once, not in a loop over contacts. */
static inline double law_damping_ratio(double restitution)
{
    const double asked = -log(restitution);
    double low = 0.0, high = 1.0 + exp(0.5 * asked);
    int k;
    if (restitution >= 1.0) return 0.0;
    for (k = 0; k < 100; k++) {
        const double middle = 0.5 * (low + high);
        if (middle <= low || middle >= high) break;
        if (law_decrement(middle) < asked) low = middle;
        else high = middle;
    }
    return 0.5 * (low + high);
}

/* Viscosity (N s/m) of the normal dashpot. */
static inline double law_viscosity(double damping, const law_pressed *p, double mass)
{
    return sqrt(2.0) * damping * sqrt(mass * (p->stiffness + p->force / p->depth));
}

/* Part of the step that is past since bodies touched, or left until they part, at the closing speed `approach`; -1 within a
   contact. */
static inline double law_edge(const law_pressed *p, double approach, double mass, double dt, int touched)
{
    const double speed = approach > 0.0 ? approach : p->force * dt / mass - approach;
    const double way = speed * dt * (1.0 + 1e-6); /* longer by the rounding of places */
    if (!(p->force > 0.0) || p->depth > way || (approach > 0.0 && touched)) return -1.0;
    return p->depth / way;
}

/* What a force that grows like t^p is multiplied by where a `part` of the step is past since first touch, so that the sum of the
   steps is its integral: (part^p - zeta(-p, part))/part^p with Hurwitz's zeta function. */
static inline double law_weight(double p, double part)
{
    const double a = part + 0.5, square = 1.0 / (a * a), third = 7.0 * p * (p - 1.0) * (p - 2.0) / 5760.0;
    return a * (1.0 / (p + 1.0) + square * (third * square - p / 24.0)) * pow(a / part, p);
}

/* Viscosity (N s/m) of the dashpot on a tangential spring. */
static inline double law_rubbing_viscosity(double damping, double stiffness, double mass)
{
    return 2.0 * sqrt(5.0 / 6.0) * (damping < 1.0 ? damping : 1.0) * sqrt(mass * stiffness);
}

/* From the second centre, or the surface, to the first centre in the middle of the step, over the present distance. */
static inline void law_middle(const law_meeting *m, const double *arms, double *middle)
{
    const double turn = 0.5 * m->dt / (arms[0] + arms[1]), along = law_dot(m->velocity, m->normal);
    int k;
    for (k = 0; k < 3; k++)
        middle[k] = m->normal[k] - turn * (m->radii[1] > 0.0 ? m->velocity[k] : along * m->normal[k]);
}

/* Takes off what of a vector lies along another. */
static inline void law_lay_across(double *vector, const double *along)
{
    const double part = law_dot(vector, along) / law_dot(along, along);
    int k;
    for (k = 0; k < 3; k++) vector[k] -= part * along[k];
}

/* Turns what was across the normal of the step before with the contact: by a reflection across the plane of the middle, and
   about the normal by what both bodies turned in the mean. */
static inline void law_turn(const law_meeting *m, const double *middle, double *vector)
{
    const double square = law_dot(middle, middle);
    const double twice = 2.0 * law_dot(vector, middle) / square;
    const double twist = 0.5 * m->dt * (law_dot(m->spins[0], middle) + law_dot(m->spins[1], middle)) / sqrt(square);
    double aside[3];
    int k;
    for (k = 0; k < 3; k++) vector[k] -= twice * middle[k];
    law_lay_across(vector, m->normal);
    law_cross(m->normal, vector, aside);
    for (k = 0; k < 3; k++) vector[k] = (1.0 - 0.5 * twist * twist) * vector[k] + twist * aside[k];
}

/* Advances a spring by `stretch`, with the present stiffness, up to `limit`. */
static inline void law_slide(law_slider *s, const double *stretch, const law_meeting *m, const double *middle,
                                double stiffness, double limit)
{
    const double follow = stiffness < s->stiffness ? stiffness / s->stiffness : 1.0;
    double flat[3], size;
    int k;
    law_turn(m, middle, s->load);
    for (k = 0; k < 3; k++) flat[k] = stretch[k];
    law_lay_across(flat, m->normal);
    for (k = 0; k < 3; k++) s->load[k] = follow * s->load[k] - stiffness * flat[k];
    size = law_dot(s->load, s->load);
    if (size > limit * limit)
        for (k = 0; k < 3; k++) s->load[k] *= limit / sqrt(size);
    s->stiffness = stiffness;
}

/* Normal force of the law with damping; `approach` is the rate of the overlap half a step before, the dashpot acts on that of the
   whole step. Its own force and the law's change it, and so does everything else that pushes the bodies, which the dashpot
   learns from step to step: at rest the two cancel. */
static inline double law_damped(const law_effects *e, const law_pressed *p, double approach, double mass, double dt,
                                   law_dashpot *d)
{
    const double share = 0.25, others = d->touched > 0.0 ? d->others + 0.5 * share * approach : 0.0;
    const double edge = law_edge(p, approach, mass, dt, d->touched > 0.0);
    double force = p->force;
    if (edge >= 0.0) force *= law_weight(p->stiffness * p->depth / p->force, edge);
    if (force > 0.0 && e->damping > 0.0) {
        double viscous = law_viscosity(e->damping, p, mass);
        if (edge >= 0.0) viscous *= law_weight(0.5 * (p->stiffness * p->depth / p->force - 1.0), edge);
        force = (force + viscous * (approach + others)) * (2.0 * mass) / (2.0 * mass + dt * viscous);
        if (force < 0.0) force = 0.0;
    }
    d->touched = 1.0;
    d->others = (1.0 - share) * others - 0.5 * share * (approach - dt / mass * force);
    return force;
}

/* Stiffness of the tangential spring, N/m. */
static inline double law_shear(const law_pressed *p, double normal_force, int on_surface)
{
    return normal_force > 0.0 ? LAW_SHEAR / (on_surface ? 1.0 : 2.0) * p->contact_radius : 0.0;
}

/* Tangential force on the first body at the relative velocity `slip` of the touching points. */
static inline void law_rub(const law_effects *e, const law_meeting *m, const double *middle, const double *slip,
                              double stiffness, double normal_force, law_slider *spring, double *force)
{
    const double limit = e->friction * normal_force;
    const double viscous = law_rubbing_viscosity(e->damping, stiffness, m->mass);
    double stretch[3], rate[3], size;
    int k;
    for (k = 0; k < 3; k++) {
        stretch[k] = slip[k] * m->dt;
        rate[k] = slip[k];
    }
    law_slide(spring, stretch, m, middle, stiffness, limit);
    law_lay_across(rate, m->normal);
    for (k = 0; k < 3; k++) force[k] = spring->load[k] - viscous * rate[k];
    size = law_dot(force, force);
    if (size > limit * limit)
        for (k = 0; k < 3; k++) force[k] *= limit / sqrt(size);
}

/* Velocity of the first body's touching point relative to the second's, across the normal of its time. */
static inline void law_slip(const law_meeting *m, const double *arms, const double *middle, double *slip)
{
    double turning[3], rolled[3];
    int k;
    for (k = 0; k < 3; k++) turning[k] = m->spins[0][k] * arms[0] + m->spins[1][k] * arms[1];
    law_cross(turning, middle, rolled);
    for (k = 0; k < 3; k++) slip[k] = m->velocity[k];
    law_lay_across(slip, middle);
    for (k = 0; k < 3; k++) slip[k] -= rolled[k];
}

/* Rate of approach, along the normal of its time. */
static inline double law_approach(const law_meeting *m, const double *middle)
{
    return -law_dot(m->velocity, middle) / sqrt(law_dot(middle, middle));
}

/* Everything the contact does: `p` is the pressed law, `dashpot`, `spring` and `roller` what it remembers. */
static inline law_push law_meet(const law_effects *e, const law_meeting *m, const law_pressed *p,
                                      law_dashpot *dashpot, law_slider *spring, law_slider *roller)
{
    const int on_surface = m->radii[1] <= 0.0;
    const double arms[2] = {m->radii[0] - p->flattening[0], on_surface ? 0.0 : m->radii[1] - p->flattening[1]};
    double middle[3], slip[3], couple[3], normal_force, stiffness;
    law_push push;
    int k;
    law_middle(m, arms, middle);
    normal_force = law_damped(e, p, law_approach(m, middle), m->mass, m->dt, dashpot);
    stiffness = law_shear(p, normal_force, on_surface);
    push.normal_force = normal_force;
    for (k = 0; k < 3; k++) {
        push.force[k] = 0.0;
        push.torque[0][k] = push.torque[1][k] = 0.0;
    }
    if (e->friction > 0.0) {
        law_slip(m, arms, middle, slip);
        law_rub(e, m, middle, slip, stiffness, normal_force, spring, push.force);
        law_cross(push.force, m->normal, couple);
        for (k = 0; k < 3; k++) {
            push.torque[0][k] = arms[0] * couple[k];
            push.torque[1][k] = arms[1] * couple[k];
        }
    }
    for (k = 0; k < 3; k++) push.force[k] += normal_force * m->normal[k];
    if (e->rolling > 0.0) {
        const double radius = on_surface ? m->radii[0] : m->radii[0] * m->radii[1] / (m->radii[0] + m->radii[1]);
        double turn[3];
        for (k = 0; k < 3; k++) turn[k] = (m->spins[0][k] - m->spins[1][k]) * m->dt;
        law_lay_across(turn, middle);
        law_slide(roller, turn, m, middle, stiffness * radius * radius, e->rolling * radius * normal_force);
        for (k = 0; k < 3; k++) {
            push.torque[0][k] += roller->load[k];
            push.torque[1][k] -= roller->load[k];
        }
    }
    return push;
}

#endif
