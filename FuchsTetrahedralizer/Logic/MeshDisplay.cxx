// SPDX-License-Identifier: Apache-2.0
#include "MeshDisplay.h"

#include "HostDifferences.h"
#include "MeshQuality.h"
#include "ModelMesh.h"
#include "TissueColors.h"
#include "vtkMRMLFuchsTetrahedralizerNode.h"

#include <vtkMRMLColorLegendDisplayNode.h>
#include <vtkMRMLColorTableNode.h>
#include <vtkMRMLModelDisplayNode.h>
#include <vtkMRMLModelNode.h>
#include <vtkMRMLScene.h>
#include <vtkMRMLSliceNode.h>
#include <vtkSlicerColorLogic.h>

// Since Slicer 5.8, every display node has a clip node of its own; before, one node clips all models that permit it.
#if __has_include(<vtkMRMLClipNode.h>)
#include <vtkMRMLClipNode.h>
#else
#include <vtkMRMLClipModelsNode.h>
#endif

#include <vtkAssignAttribute.h>
#include <vtkCellData.h>
#include <vtkFloatArray.h>
#include <vtkLookupTable.h>
#include <vtkNew.h>
#include <vtkTextProperty.h>
#include <vtkUnstructuredGrid.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <functional>
#include <string>

namespace surgicalmesher
{
namespace
{

using Parameters = vtkMRMLFuchsTetrahedralizerNode;
using Color = std::array<double, 3>;

/// Returns the colour table for an array. The mesh references it by a role named after the array, so that it is found
/// again even while other colours are shown.
vtkMRMLColorTableNode* colorsFor(vtkMRMLModelNode* mesh, const char* scalars)
{
  const std::string role = std::string("colors") + scalars;
  auto* colors = vtkMRMLColorTableNode::SafeDownCast(mesh->GetNodeReference(role.c_str()));
  if (colors) return colors;
  colors = vtkMRMLColorTableNode::SafeDownCast(
    mesh->GetScene()->AddNewNodeByClass("vtkMRMLColorTableNode", std::string(mesh->GetName()) + " " + scalars));
  mesh->SetNodeReferenceID(role.c_str(), colors->GetID());
  return colors;
}

/// Fills a colour table with categories numbered from 0, each with its name and colour.
void fillCategories(vtkMRMLColorTableNode* colors, const std::vector<Tissue>& categories)
{
  TissueTable table;
  for (std::size_t i = 0; i < categories.size(); ++i) table[Label(i)] = categories[i];
  fillColorTable(table, colors);
  const Tissue& first = categories.front(); // which fillColorTable() makes transparent background
  colors->SetColor(0, first.name.c_str(), first.color[0], first.color[1], first.color[2], 1);
}

/// Fills a ramp from red (bad) over yellow to blue (good), which is distinguishable with colour blindness.
void fillRamp(vtkMRMLColorTableNode* colors, double highest)
{
  constexpr int count = 256;
  constexpr std::array<Color, 3> stops{ { { 0.84, 0.10, 0.11 }, { 1.0, 1.0, 0.75 }, { 0.17, 0.48, 0.71 } } };
  std::vector<Tissue> ramp(count);
  for (int i = 0; i < count; ++i)
  {
    const double place = 2.0 * i / (count - 1);
    const int stop = std::min(int(place), 1);
    for (int c = 0; c < 3; ++c)
      ramp[i].color[c] = stops[stop][c] + (place - stop) * (stops[stop + 1][c] - stops[stop][c]);
    ramp[i].name = std::to_string(highest * i / (count - 1));
  }
  fillCategories(colors, ramp);
  colors->GetLookupTable()->SetTableRange(0, highest);
}

std::vector<Tissue> subMeshCategories(vtkMRMLModelNode* mesh)
{
  constexpr std::array<Color, 6> palette{ { { 0.90, 0.62, 0.00 },
                                            { 0.34, 0.71, 0.91 },
                                            { 0.00, 0.62, 0.45 },
                                            { 0.80, 0.47, 0.65 },
                                            { 0.94, 0.89, 0.26 },
                                            { 0.00, 0.45, 0.70 } } };
  std::vector<Tissue> categories{
    { vtkMRMLTr("vtkSlicerFuchsTetrahedralizerLogic", "parent"), { 0.75, 0.75, 0.75 }, false }
  };
  vtkDataArray* subMesh = mesh->GetMesh()->GetCellData()->GetArray("SubMesh");
  for (int child = 1; child <= int(subMesh->GetRange()[1]); ++child)
  {
    categories.push_back({ vtkMRMLTr("vtkSlicerFuchsTetrahedralizerLogic", "child") + " " + std::to_string(child),
                           palette[(child - 1) % palette.size()], false });
  }
  return categories;
}

std::vector<Tissue> constitutiveCategories()
{
  return { { vtkMRMLTr("vtkSlicerFuchsTetrahedralizerLogic", "linear"), { 0.75, 0.75, 0.75 }, false },
           { vtkMRMLTr("vtkSlicerFuchsTetrahedralizerLogic", "nonlinear"), { 0.90, 0.62, 0.00 }, false },
           { vtkMRMLTr("vtkSlicerFuchsTetrahedralizerLogic", "null displacement"), { 0.00, 0.45, 0.70 }, false } };
}

using Measure = std::function<double(const Vec3&, const Vec3&, const Vec3&, const Vec3&)>;

double minimumDihedralAngle(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d)
{
  const auto angles = dihedralAngles(a, b, c, d);
  return *std::min_element(angles.begin(), angles.end());
}

void addMeasure(vtkMRMLModelNode* mesh, const char* name, const Measure& measure)
{
  vtkUnstructuredGrid* grid = mesh->GetUnstructuredGrid();
  if (grid->GetCellData()->GetArray(name)) return;
  vtkNew<vtkFloatArray> values;
  values->SetName(name);
  values->SetNumberOfTuples(grid->GetNumberOfCells());
  for (vtkIdType i = 0; i < grid->GetNumberOfCells(); ++i)
  {
    vtkIdType size;
    const vtkIdType* ids;
    grid->GetCells()->GetCellAtId(i, size, ids);
    std::array<Vec3, 4> p;
    for (int corner = 0; corner < 4 && size == 4; ++corner) grid->GetPoint(ids[corner], &p[corner].x);
    values->SetValue(i, size == 4 ? float(measure(p[0], p[1], p[2], p[3])) : 0);
  }
  mesh->AddCellScalars(values);
}

void show(vtkMRMLModelNode* mesh, const char* scalars, vtkMRMLColorTableNode* colors)
{
  vtkMRMLModelDisplayNode* display = mesh->GetModelDisplayNode();
  const int wasModifying = display->StartModify();
  display->SetActiveScalar(scalars, vtkAssignAttribute::CELL_DATA);
  display->SetAndObserveColorNodeID(colors->GetID());
  display->SetScalarRangeFlag(vtkMRMLDisplayNode::UseManualScalarRange);
  display->SetScalarRange(colors->GetLookupTable()->GetTableRange());
  display->ScalarVisibilityOn();
  display->EndModify(wasModifying);
}

bool comesBefore(vtkMRMLNode* a, vtkMRMLNode* b)
{
  vtkMRMLScene* scene = a->GetScene();
  int i = 0;
  while (scene->GetNthNode(i) != a && scene->GetNthNode(i) != b) ++i;
  return scene->GetNthNode(i) == a;
}

/// Slicer accesses the colours of a legend as soon as it loads the legend, which must therefore follow them in the
/// scene.
void removeEarlyLegend(vtkMRMLDisplayNode* display)
{
  vtkMRMLNode* legend = vtkSlicerColorLogic::GetColorLegendDisplayNode(display);
  if (legend && comesBefore(legend, display->GetColorNode())) display->GetScene()->RemoveNode(legend);
}

/// Shows a legend beside the mesh: colours with their names, or a scale of numbers. With too many names to be legible,
/// the legend is hidden.
void showLegend(vtkMRMLModelNode* mesh, const std::string& title, bool byName)
{
  constexpr int legible = 12;
  if (!mesh->GetScene()->IsNodeClassRegistered("vtkMRMLColorLegendDisplayNode")) return; // without Slicer's legends
  vtkMRMLDisplayNode* display = mesh->GetModelDisplayNode();
  auto* colors = vtkMRMLColorTableNode::SafeDownCast(display->GetColorNode());
  removeEarlyLegend(display);
  vtkMRMLColorLegendDisplayNode* legend = vtkSlicerColorLogic::AddDefaultColorLegendDisplayNode(display);
  const int wasModifying = legend->StartModify();
  legend->SetTitleText(title);
  legend->SetUseColorNamesForLabels(byName);
  legend->SetMaxNumberOfColors(colors->GetNumberOfColors());
  legend->SetLabelFormat(byName ? legend->GetDefaultTextLabelFormat() : legend->GetDefaultNumericLabelFormat());
  legend->SetVisibility(!byName || colors->GetNumberOfColors() <= legible);
  legend->SetVisibility2D(false);
  legend->SetNumberOfLabels(6); // numbers: 0, 0.2 ... 1
  legend->SetSize(0.08, 0.35);
  legend->GetLabelTextProperty()->SetFontFamilyToArial();
  legend->EndModify(wasModifying);
}

constexpr double regularAngle = 70.53; // dihedral angle of a regular tetrahedron, degrees

bool colorByMeasure(vtkMRMLModelNode* mesh, int colorBy)
{
  const bool byAngle = colorBy == Parameters::MinimumDihedralAngle;
  const char* scalars = byAngle ? "MinimumDihedralAngle" : "RadiusRatio";
  addMeasure(mesh, scalars, byAngle ? Measure(minimumDihedralAngle) : Measure(radiusRatio));
  vtkMRMLColorTableNode* colors = colorsFor(mesh, scalars);
  fillRamp(colors, byAngle ? regularAngle : 1);
  show(mesh, scalars, colors);
  showLegend(mesh,
             byAngle ? vtkMRMLTr("vtkSlicerFuchsTetrahedralizerLogic", "degrees")
                     : vtkMRMLTr("vtkSlicerFuchsTetrahedralizerLogic", "radius ratio"),
             false);
  return true;
}

bool colorByCategory(vtkMRMLModelNode* mesh, int colorBy)
{
  const bool bySubMesh = colorBy == Parameters::SubMesh;
  const char* scalars = bySubMesh ? "SubMesh" : "Constitutive";
  if (!mesh->GetMesh()->GetCellData()->GetArray(scalars)) return false;
  vtkMRMLColorTableNode* colors = colorsFor(mesh, scalars);
  fillCategories(colors, bySubMesh ? subMeshCategories(mesh) : constitutiveCategories());
  show(mesh, scalars, colors);
  showLegend(mesh,
             bySubMesh ? vtkMRMLTr("vtkSlicerFuchsTetrahedralizerLogic", "sub-meshes")
                       : vtkMRMLTr("vtkSlicerFuchsTetrahedralizerLogic", "classes"),
             true);
  return true;
}

} // namespace

bool colorMesh(vtkMRMLModelNode* mesh, int colorBy)
{
  if (!mesh->GetUnstructuredGrid()) return false;
  mesh->CreateDefaultDisplayNodes();
  switch (colorBy)
  {
  case Parameters::Tissue:
    if (!mesh->GetMesh()->GetCellData()->GetArray("TissueLabel")) return false;
    showTissueColors(mesh, "TissueLabel");
    showLegend(mesh, vtkMRMLTr("vtkSlicerFuchsTetrahedralizerLogic", "tissues"), true);
    return true;
  case Parameters::SubMesh:
  case Parameters::ConstitutiveClass: return colorByCategory(mesh, colorBy);
  default: return colorByMeasure(mesh, colorBy);
  }
}

vtkMRMLSliceNode* sliceOfPlane(vtkMRMLScene* scene, int plane)
{
  constexpr std::array<const char*, Parameters::ClipPlane_Last> views{ "", "Red", "Yellow", "Green" };
  std::vector<vtkMRMLNode*> slices;
  scene->GetNodesByClass("vtkMRMLSliceNode", slices);
  for (vtkMRMLNode* node : slices)
  {
    auto* slice = vtkMRMLSliceNode::SafeDownCast(node);
    if (slice->GetLayoutName() && !std::strcmp(slice->GetLayoutName(), views[plane])) return slice;
  }
  return nullptr;
}

#if __has_include(<vtkMRMLClipNode.h>)

void clipMesh(vtkMRMLModelNode* mesh, int plane, bool flipped)
{
  mesh->CreateDefaultDisplayNodes();
  vtkMRMLDisplayNode* display = mesh->GetDisplayNode();
  vtkMRMLSliceNode* slice = sliceOfPlane(mesh->GetScene(), plane);
  display->SetClipping(slice != nullptr);
  if (!slice) return;
  vtkMRMLClipNode* clip = display->GetClipNode();
  if (!clip)
  {
    clip = vtkMRMLClipNode::SafeDownCast(
      mesh->GetScene()->AddNewNodeByClass("vtkMRMLClipNode", std::string(mesh->GetName()) + " clip"));
    display->SetAndObserveClipNodeID(clip->GetID());
  }
  clip->SetClippingMethod(vtkMRMLClipNode::WholeCells);
  clip->RemoveAllClippingNodeIDs();
  clip->AddAndObserveClippingNodeID(slice->GetID());
  clip->SetClippingNodeState(slice, flipped ? vtkMRMLClipNode::ClipPositiveSpace : vtkMRMLClipNode::ClipNegativeSpace);
}

#else

void clipMesh(vtkMRMLModelNode* mesh, int plane, bool flipped)
{
  using Clip = vtkMRMLClipModelsNode;
  mesh->CreateDefaultDisplayNodes();
  const bool clips = sliceOfPlane(mesh->GetScene(), plane) != nullptr;
  mesh->GetDisplayNode()->SetClipping(clips);
  if (!clips) return;
  auto* clip = Clip::SafeDownCast(mesh->GetScene()->GetFirstNodeByClass("vtkMRMLClipModelsNode"));
  if (!clip) clip = Clip::SafeDownCast(mesh->GetScene()->AddNewNodeByClass("vtkMRMLClipModelsNode"));
  const int side = flipped ? Clip::ClipPositiveSpace : Clip::ClipNegativeSpace;
  const int wasModifying = clip->StartModify();
  clip->SetClippingMethod(Clip::WholeCells);
  clip->SetRedSliceClipState(plane == Parameters::Axial ? side : Clip::ClipOff);
  clip->SetYellowSliceClipState(plane == Parameters::Sagittal ? side : Clip::ClipOff);
  clip->SetGreenSliceClipState(plane == Parameters::Coronal ? side : Clip::ClipOff);
  clip->EndModify(wasModifying);
}

#endif

} // namespace surgicalmesher
