# YADE: the silo of cases/bed-hopper.toml, from silo.data and triangles that silo.sh writes; rows as in silo.in.
import os
from yade import ymport
from math import atan

axis, box, inner, high, mu = (float(os.environ[key]) for key in ('axis', 'box', 'inner', 'high', 'mu'))
glass = O.materials.append(FrictMat(young=7e6, poisson=0.22, density=2500, frictionAngle=atan(mu), label='glass'))
wall = O.materials.append(FrictMat(young=7e12, poisson=0.22, density=2500, frictionAngle=atan(mu), label='wall'))
tube = O.bodies.append(ymport.stl('tube.stl', material='wall'))
floor = O.bodies.append(ymport.stl('floor.stl', material='wall'))
gate = O.bodies.append(ymport.stl('gate.stl', material='wall'))
for axis, at in ((0, 0.), (0, box), (1, 0.), (1, box), (2, 0.)):
    p = [box / 2, box / 2, 0.025]; p[axis] = at
    O.bodies.append(utils.wall(p, axis, material='wall'))
grains = []
started = False
for line in open('silo.data'):
    f = line.split()
    if f and f[0] == 'Atoms': started = True
    elif started and len(f) == 7:
        grains.append(O.bodies.append(sphere((float(f[4]), float(f[5]), float(f[6])), float(f[2]) / 2, material='glass')))
O.engines = [
    ForceResetter(),
    InsertionSortCollider([Bo1_Sphere_Aabb(), Bo1_Facet_Aabb(), Bo1_Wall_Aabb()], verletDist=2e-4),
    InteractionLoop([Ig2_Sphere_Sphere_ScGeom(), Ig2_Facet_Sphere_ScGeom(hertzian=True), Ig2_Wall_Sphere_ScGeom(hertzian=True)],
        [Ip2_FrictMat_FrictMat_MindlinPhys(en=0.7)],
        [Law2_ScGeom_MindlinPhys_Mindlin()]),
    NewtonIntegrator(damping=0, gravity=(0, 0, -9.81)),
]
O.dt = 1.5e-5
def state():
    out = inside = 0.
    for i in grains:
        b = O.bodies[i]; x, y, z = b.state.pos
        if z < 0.055: out += b.state.mass
        if 0.065 < z < 0.065 + high and (x - axis)**2 + (y - axis)**2 < inner**2: inside += b.state.mass
    print(O.iter, out, inside, 0, 0, flush=True)
def steps(n):
    for k in range(n // 500):
        O.run(500, True); state()
steps(26500)
for i in gate: O.bodies.erase(i)
steps(200000)
