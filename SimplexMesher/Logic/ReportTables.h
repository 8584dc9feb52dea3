// SPDX-License-Identifier: Apache-2.0
#pragma once
/// The report of a run as tables and plots of the scene.

#include <string>
#include <vector>

class vtkMRMLModelNode;
class vtkMRMLPlotChartNode;
class vtkMRMLTableNode;

namespace surgicalmesher
{

/// Fills one row per tissue of `surface`: label, name, area (mm^2), triangles, components, tunnels and cavities of the
/// prepared map, islands removed, voxels lost and gained by resolving contacts, share of the surface thinner than the
/// edge length (%), its smallest thickness (mm; 0 if nothing is thinner), volume in the prepared map and of the mesh
/// (mm^3), and the largest distances from map to mesh and from mesh to map (mm). `reportFile` is the JSON report of
/// SimplexMesherCLI; throws InputError if it is not valid.
void fillTissueTable(const std::string& reportFile, vtkMRMLModelNode* surface, vtkMRMLTableNode* table);

/// Fills one row per step: number, stage, tetrahedra, faces, mean and maximum distance to the tissue boundary (mm),
/// boundary samples beyond their tolerance, operations on the interface by their names in the simplex mesh, and
/// operations on any edge of the tetrahedra. Throws InputError as above.
void fillEvolutionTable(const std::string& reportFile, vtkMRMLTableNode* table);

/// Fills one row per kind of roughness that smoothing removed from the map, per reason for folds of the surface, and
/// for pieces of tissues that hang by one face: count, voxels, length (mm) and volume (mm^3), 0 where not applicable.
/// Throws InputError as above.
void fillShapeTable(const std::string& reportFile, vtkMRMLTableNode* table);

/// Fill one row for each of the longest folds, or the largest ears, of the report, with the tissue names of `surface`
/// and positions in RAS. Throw InputError as above.
void fillFoldTable(const std::string& reportFile, vtkMRMLModelNode* surface, vtkMRMLTableNode* table);
void fillEarTable(const std::string& reportFile, vtkMRMLModelNode* surface, vtkMRMLTableNode* table);

/// Plots the evolution table: faces, distance, operations. `charts` are those of an earlier run, which are reused, or
/// empty; new ones are named after the table.
std::vector<vtkMRMLPlotChartNode*> plotEvolution(vtkMRMLTableNode* table,
                                                 const std::vector<vtkMRMLPlotChartNode*>& charts);

} // namespace surgicalmesher
