// SPDX-License-Identifier: Apache-2.0
// Tissues of a label map, and the tetrahedra of a mesh of it. usage: count_elements MAP MESH

#include <Errors.h>
#include <MeshIO.h>
#include <MeshQuality.h>
#include <TissueMapIO.h>

#include <iostream>

int main(int argc, char** argv)
{
  if (argc != 3) return 2;
  try
  {
    const surgicalmesher::TissueMap map = surgicalmesher::readTissueMap(argv[1]);
    const surgicalmesher::MeshFile content = surgicalmesher::readMesh(argv[2]);
    const surgicalmesher::MeshQuality quality = surgicalmesher::assessQuality(content.mesh, content.subMesh, {});
    std::cout << surgicalmesher::presentLabels(map).size() << " tissues, " << quality.whole.tetrahedra
              << " tetrahedra\n";
  }
  catch (const surgicalmesher::Error& error)
  {
    std::cerr << error.what() << "\n";
    return error.exitStatus();
  }
  return 0;
}
