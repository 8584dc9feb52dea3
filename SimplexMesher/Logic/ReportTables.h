// SPDX-License-Identifier: Apache-2.0
#pragma once
/// The report of a run as the host's tables and plots.

#include <string>
#include <vector>

class vtkMRMLModelNode;
class vtkMRMLPlotChartNode;
class vtkMRMLTableNode;

namespace surgicalmesher
{

/// One row per tissue of `surface`: label, name, area (mm^2), triangles, components, tunnels and cavities of the
/// prepared map, islands removed, voxels lost and gained while contacts were resolved, share of the surface thinner
/// than the edge length (%), its smallest thickness (mm; 0 where nothing is thinner), volume in the prepared map and of
/// the mesh (mm^3), and the largest distances from map to mesh and from mesh to map (mm). `reportFile` is the JSON file
/// of SimplexMesherCLI; throws InputError if it isn't one.
void fillTissueTable(const std::string& reportFile, vtkMRMLModelNode* surface, vtkMRMLTableNode* table);

/// One row per step: number, stage, tetrahedra, faces, mean and maximum distance to the tissue boundary (mm), boundary
/// samples beyond their tolerance, the operations on the interface by their names in the simplex mesh, and those on any
/// edge of the tetrahedra. Throws InputError likewise.
void fillEvolutionTable(const std::string& reportFile, vtkMRMLTableNode* table);

/// One row per kind of roughness that smoothing took from the map, per reason for folds of the surface, and for pieces
/// of tissues that hang by one face: count, voxels, length (mm) and volume (mm^3), 0 where a kind has no such figure.
/// Throws InputError likewise.
void fillShapeTable(const std::string& reportFile, vtkMRMLTableNode* table);

/// The report's longest folds and its largest ears, a row each, with the names that `surface` has of tissues, and their
/// places in RAS. Throw InputError likewise.
void fillFoldTable(const std::string& reportFile, vtkMRMLModelNode* surface, vtkMRMLTableNode* table);
void fillEarTable(const std::string& reportFile, vtkMRMLModelNode* surface, vtkMRMLTableNode* table);

/// Plots of the evolution table: faces, distance, operations. `charts` are those of an earlier run, to be filled
/// again, or empty; new ones are called after the table.
std::vector<vtkMRMLPlotChartNode*> plotEvolution(vtkMRMLTableNode* table,
                                                 const std::vector<vtkMRMLPlotChartNode*>& charts);

} // namespace surgicalmesher
