# Impact of two equal spheres under a model of YADE (2023.02): overlap, rate of approach and force.
#     V=@SPEED@ DT=@DT@ STEPS=@STEPS@ yade -n -x @FILE@
# V: relative speed, m/s; DT: time step, s. The restitution is the last rate over -V. The lines of the material hold for this
# radius. This DT shows the model to many digits; a deck is well served by @SUGGESTED@ s, in proportion to the smallest radius.
# Spheres only: against a wall or facet the model divides by the radius of the second body, which has none.
import os

from yade import *

R, V = @RADIUS@, float(os.environ.get("V", "@SPEED@"))
dt, steps = float(os.environ.get("DT", "@DT@")), int(os.environ.get("STEPS", "@STEPS@"))
every = int(os.environ.get("EVERY", "10"))

@LINES@
O.materials.append(grain)
a = O.bodies.append(sphere((-R, 0, 0), R, material=grain))
b = O.bodies.append(sphere((R, 0, 0), R, material=grain))
O.bodies[a].state.vel = (V / 2, 0, 0)
O.bodies[b].state.vel = (-V / 2, 0, 0)
O.engines = [
    ForceResetter(),
    InsertionSortCollider([Bo1_Sphere_Aabb()], verletDist=0.1 * R),
    InteractionLoop(
        [Ig2_Sphere_Sphere_ScGeom()],
        [Ip2_LudingMat_LudingMat_LudingPhys()],
        [Law2_ScGeom_LudingPhys_Basic()],
    ),
    NewtonIntegrator(damping=0),
]
O.dt = dt
for step in range(1, steps + 1):
    O.step()
    if step % every == 0:
        first, second = O.bodies[a].state, O.bodies[b].state
        overlap, rate = 2 * R - (second.pos[0] - first.pos[0]), first.vel[0] - second.vel[0]
        print(step, repr(overlap), repr(rate), repr(abs(O.forces.f(a)[0])))
