#!/usr/bin/python3
"""FreeFEM: a head sags under its weight in its fluid. usage: run_freefem.py mesh.mesh CLAMPED_SURFACE...

Writes gravity.edp, the script for FreeFEM, beside the mesh.
"""
import os
import subprocess
import sys

from sidecar import GRAVITY, Sidecar, lame

SCRIPT = """mesh3 Th = readmesh3("{mesh}");
fespace Ph(Th, P0);
real[int] firstOf = [{first}], shearOf = [{shear}], densityOf = [{density}]; // by label
Ph first = firstOf[region], shear = shearOf[region], density = densityOf[region];

fespace Vh(Th, [P1, P1, P1]);
Vh [ux, uy, uz], [vx, vy, vz];
macro strain(x, y, z) [dx(x), dy(y), dz(z),
  (dy(x) + dx(y)) / sqrt(2.), (dz(x) + dx(z)) / sqrt(2.), (dz(y) + dy(z)) / sqrt(2.)] // EOM
macro div(x, y, z) (dx(x) + dy(y) + dz(z)) // EOM
solve gravity([ux, uy, uz], [vx, vy, vz], solver=CG, eps=1e-9)
  = int3d(Th)(first * div(ux, uy, uz) * div(vx, vy, vz) + 2 * shear * strain(ux, uy, uz)' * strain(vx, vy, vz))
  + int3d(Th)({gravity} * density * vz)
  + on({clamped}, ux=0, uy=0, uz=0);

fespace Sh(Th, P1);
Sh size = sqrt(ux^2 + uy^2 + uz^2);
int[int] found = regions(Th);
cout.precision(12);
cout << "nodes " << Th.nv << endl << "elements " << Th.nt << endl << "tissues " << found.n << endl;
cout << "displacement " << size[].max << endl;
"""

folder, file = os.path.split(os.path.abspath(sys.argv[1]))
sidecar = Sidecar(sys.argv[1])
materials = sidecar.material_of_tissues()
by_label = [materials.get(label) for label in range(max(materials) + 1)]
constants = [(*lame(material), material["density"]) if material else (0.0, 0.0, 0.0) for material in by_label]
first, shear, density = (", ".join(map(repr, column)) for column in zip(*constants))
with open(os.path.join(folder, "gravity.edp"), "w", encoding="ascii") as script:
    script.write(SCRIPT.format(mesh=file, gravity=GRAVITY, first=first, shear=shear, density=density,
                               clamped=", ".join(map(str, sidecar.face_tags(sys.argv[2:])))))
sys.exit(subprocess.run(["FreeFem++-nw", "-nw", "-v", "0", "gravity.edp"], cwd=folder).returncode)
