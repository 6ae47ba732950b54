/* C interface of impactlaw: reads a law file and presses contacts under it. SI units; overlap > 0 in contact, force > 0
   repels, rate > 0 approaches. Made by cbindgen from src/capi/lib.rs.

   Build:  cargo build --release -p impactlaw-c
   Link:   cc program.c -Ltarget/release -limpactlaw_c -lm

   A law that need not be read at run time is one header without a library: impactlaw export LAW --to c. */

#ifndef IMPACTLAW_H
#define IMPACTLAW_H

#include <stddef.h>

// A contact under a law, with what it remembers.
typedef struct impactlaw_contact impactlaw_contact;

// A law read from a file.
typedef struct impactlaw_law impactlaw_law;

// A pressed contact, SI units.
typedef struct {
  // Normal force, N, repulsive and never tensile.
  double force;
  // Tangent stiffness dF/d(overlap) of the present branch without inertia, N/m.
  double stiffness;
  // Contact radius, m.
  double contact_radius;
  // Flattening of the first and of the second body, m; their sum is the overlap.
  double flattening[2];
  // Recoverable energy of both bodies, J.
  double elastic_energy;
} impactlaw_pressed;

#ifdef __cplusplus
extern "C" {
#endif // __cplusplus

// Reads a law file. NULL where that fails: `message`, if not NULL, then holds the reason, cut to its `capacity` bytes.
//
// # Safety
// `path` must be a string that ends with 0; `message` NULL or writable for `capacity` bytes.
impactlaw_law *impactlaw_law_read(const char *path,
                                  char *message,
                                  size_t capacity);

// Frees a law; NULL is allowed. Contacts made of it live on.
//
// # Safety
// `law` must come from `impactlaw_law_read` and not be used again.
void impactlaw_law_free(impactlaw_law *law);

// Largest flattening over radius that the law's impacts support; beyond, it is extrapolated.
//
// # Safety
// `law` must come from `impactlaw_law_read`.
double impactlaw_law_valid_to(const impactlaw_law *law);

// Suggested time step (s) for bodies of at least this radius (m).
//
// # Safety
// `law` must come from `impactlaw_law_read`.
double impactlaw_law_time_step(const impactlaw_law *law, double radius);

// A contact under the law that has not been pressed yet; free it with `impactlaw_contact_free`.
//
// # Safety
// `law` must come from `impactlaw_law_read`.
impactlaw_contact *impactlaw_contact_new(const impactlaw_law *law);

// Presses a body on a rigid wall (`radius_2` 0) or two bodies of the law's material (m), and remembers it. `rate` (m/s) is
// that of the overlap and serves the inertia of fast first loading alone; 0 leaves that out, as beds do.
//
// # Safety
// `contact` must come from `impactlaw_contact_new` and be used by no other thread meanwhile.
impactlaw_pressed impactlaw_contact_press(impactlaw_contact *contact,
                                          double overlap,
                                          double radius_1,
                                          double radius_2,
                                          double rate);

// Begins a contact anew: call it when the bodies no longer overlap.
//
// # Safety
// As `impactlaw_contact_press`.
void impactlaw_contact_forget(impactlaw_contact *contact);

// Frees a contact; NULL is allowed.
//
// # Safety
// `contact` must come from `impactlaw_contact_new` and not be used again.
void impactlaw_contact_free(impactlaw_contact *contact);

#ifdef __cplusplus
}  // extern "C"
#endif  // __cplusplus

#endif  /* IMPACTLAW_H */
