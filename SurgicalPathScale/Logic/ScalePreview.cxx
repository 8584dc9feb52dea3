// SPDX-License-Identifier: Apache-2.0
#include "ScalePreview.h"

#include "HostDifferences.h"
#include "ScaleInputs.h"
#include "SceneNodes.h"
#include "TissueColors.h"
#include "TissueMapInput.h"
#include "vtkMRMLSurgicalPathScaleNode.h"

#include <vtkMRMLColorLegendDisplayNode.h>
#include <vtkMRMLColorTableNode.h>
#include <vtkMRMLLabelMapVolumeDisplayNode.h>
#include <vtkMRMLLabelMapVolumeNode.h>
#include <vtkMRMLScalarVolumeDisplayNode.h>
#include <vtkMRMLScalarVolumeNode.h>
#include <vtkMRMLScene.h>
#include <vtkMRMLSliceCompositeNode.h>
#include <vtkSlicerColorLogic.h>

#include <vtkCollection.h>
#include <vtkFloatArray.h>
#include <vtkImageData.h>
#include <vtkMatrix4x4.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkTextProperty.h>
#include <vtkUnsignedCharArray.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace surgicalmesher
{

using Node = vtkMRMLSurgicalPathScaleNode;

namespace
{

constexpr double previewVoxels = 2e5;
constexpr double estimateVoxels = 1e6;
constexpr double labelVoxels = 5e5;
constexpr double overlayOpacity = 0.5;
constexpr const char* scaleColors = "vtkMRMLColorTableNodeFileHotToColdRainbow.txt";

/// Returns the requested spacing, or the one that yields a volume of about `voxels` voxels if that is larger.
double coarseSpacing(const Grid& grid, double asked, double voxels)
{
  double volume = 1;
  for (int axis = 0; axis < 3; ++axis) volume *= grid.size[axis] * grid.spacing[axis];
  return std::max(asked, std::cbrt(volume / voxels));
}

TissueMap thinned(const TissueMap& map, double voxels)
{
  return everyNth(map, std::max(1, int(std::ceil(std::cbrt(double(map.grid.voxelCount()) / voxels)))));
}

/// Adds a volume node with its display node, both hidden. The volume has its voxels before the scene can access them.
template <typename Volume, typename Display>
vtkSmartPointer<Volume> addHiddenVolume(vtkMRMLScene* scene, const char* name, const Grid& grid, vtkImageData* image)
{
  auto volume = vtkSmartPointer<Volume>::New();
  volume->SetName(name);
  setGrid(volume, grid);
  volume->SetAndObserveImageData(image);
  addHidden(scene, volume);
  vtkNew<Display> display;
  addHidden(scene, display);
  volume->SetAndObserveDisplayNodeID(display->GetID());
  return volume;
}

void setVoxels(vtkMRMLVolumeNode* volume, const Grid& grid, vtkImageData* image)
{
  const int wasModifying = volume->StartModify();
  setGrid(volume, grid);
  volume->SetAndObserveImageData(image);
  volume->EndModify(wasModifying);
}

template <typename Array, typename T>
vtkSmartPointer<vtkImageData> makeImage(const Grid& grid, const std::vector<T>& values)
{
  vtkNew<Array> scalars;
  scalars->SetNumberOfValues(vtkIdType(values.size()));
  std::copy(values.begin(), values.end(), scalars->GetPointer(0));
  auto image = vtkSmartPointer<vtkImageData>::New();
  image->SetDimensions(grid.size.data());
  image->GetPointData()->SetScalars(scalars);
  return image;
}

std::string textOf(const char* id) { return id ? id : ""; }

/// Returns the id, or null if the scene has no such node any more.
const char* idInScene(vtkMRMLScene* scene, const std::string& id)
{
  return scene->GetNodeByID(id) ? id.c_str() : nullptr;
}

std::vector<vtkMRMLSliceCompositeNode*> sliceViews(vtkMRMLScene* scene)
{
  std::vector<vtkMRMLNode*> nodes;
  scene->GetNodesByClass("vtkMRMLSliceCompositeNode", nodes);
  std::vector<vtkMRMLSliceCompositeNode*> views;
  for (vtkMRMLNode* node : nodes) views.push_back(vtkMRMLSliceCompositeNode::SafeDownCast(node));
  return views;
}

} // namespace

void showInSliceViews(vtkMRMLScalarVolumeNode* scale)
{
  for (vtkMRMLSliceCompositeNode* view : sliceViews(scale->GetScene()))
  {
    const int wasModifying = view->StartModify();
    view->SetForegroundVolumeID(scale->GetID());
    view->SetForegroundOpacity(overlayOpacity);
    view->EndModify(wasModifying);
  }
}

void setGrid(vtkMRMLVolumeNode* node, const Grid& grid)
{
  vtkNew<vtkMatrix4x4> matrix;
  const Vec3 toRAS{ -1, -1, 1 };
  for (int row = 0; row < 3; ++row)
  {
    for (int axis = 0; axis < 3; ++axis)
      matrix->SetElement(row, axis, toRAS[row] * grid.axes[axis][row] * grid.spacing[axis]);
    matrix->SetElement(row, 3, toRAS[row] * grid.origin[row]);
  }
  node->SetIJKToRASMatrix(matrix);
}

void setScaleColors(vtkMRMLScalarVolumeNode* node, double shortest, double longest)
{
  vtkMRMLScalarVolumeDisplayNode* display = node->GetScalarVolumeDisplayNode();
  if (!display) return;
  const int wasModifying = display->StartModify();
  display->SetAndObserveColorNodeID(scaleColors);
  display->SetAutoWindowLevel(false);
  // The first entry of the colour table is no colour.
  const double lower = shortest - 0.005 * std::max(longest - shortest, 1e-3);
  display->SetWindowLevelMinMax(lower, longest);
  display->SetInterpolate(true);
  display->EndModify(wasModifying);
  if (!node->GetScene()->IsNodeClassRegistered("vtkMRMLColorLegendDisplayNode")) return; // without Slicer's legends
  vtkMRMLColorLegendDisplayNode* legend = vtkSlicerColorLogic::AddDefaultColorLegendDisplayNode(display);
  legend->SetTitleText(vtkMRMLTr("vtkSlicerSurgicalPathScaleLogic", "Edge length (mm)"));
  legend->SetLabelFormat("%.1f");
  legend->GetLabelTextProperty()->SetFontFamilyToArial();
  legend->SetSize(0.08, 0.4);
  legend->SetHideFromEditors(node->GetHideFromEditors());
  legend->SetSaveWithScene(node->GetSaveWithScene());
}

ScalePreview::~ScalePreview() { this->hide(); }

const TissueMap& ScalePreview::tissueMap(vtkMRMLNode* input)
{
  const vtkMTimeType time = tissueMapTime(input);
  if (!m_Map || input != m_Input || time != m_InputTime)
  {
    m_Map.reset();
    m_Map = std::make_unique<TissueMap>(readTissueMap(input));
    m_Input = input;
    m_InputTime = time;
  }
  return *m_Map;
}

void ScalePreview::show(vtkMRMLSurgicalPathScaleNode* parameters)
{
  const TissueMap& map = this->tissueMap(parameters->GetNodeReference(Node::TissueMapRole()));
  const Focus focus = focusOf(parameters);
  SurgicalScaleOptions options = scaleOptions(parameters, map.table);
  options.spacing = coarseSpacing(map.grid, options.spacing, previewVoxels);
  this->showScale(parameters->GetScene(), computeSurgicalScale(map, focus.targets, focus.paths, options));
  if (parameters->WantsNullDisplacement()) this->showNullDisplacement(parameters, map);
  else this->hideNullDisplacement();
  this->putIntoSliceViews(parameters->GetScene());
}

void ScalePreview::showScale(vtkMRMLScene* scene, const ScaleField& scale)
{
  if (m_Scale && m_Scale->GetScene() != scene) this->hide();
  const vtkSmartPointer<vtkImageData> image = makeImage<vtkFloatArray>(scale.grid, scale.lengths);
  if (m_Scale) setVoxels(m_Scale, scale.grid, image);
  else
    m_Scale = addHiddenVolume<vtkMRMLScalarVolumeNode, vtkMRMLScalarVolumeDisplayNode>(scene, "Preview of edge lengths",
                                                                                       scale.grid, image);
  const auto extremes = std::minmax_element(scale.lengths.begin(), scale.lengths.end());
  setScaleColors(m_Scale, *extremes.first, *extremes.second);
}

void ScalePreview::showNullDisplacement(vtkMRMLSurgicalPathScaleNode* parameters, const TissueMap& map)
{
  TissueMap thin = thinned(map, labelVoxels);
  const Focus focus = focusOf(parameters);
  const NullDisplacement held =
    markNullDisplacement(thin, focus.targets, focus.paths, nullDisplacementOptions(parameters, map.table));
  std::vector<unsigned char> isHeld(thin.labels.size());
  std::transform(thin.labels.begin(), thin.labels.end(), isHeld.begin(),
                 [&](Label label) { return static_cast<unsigned char>(held.voxelCount > 0 && label == held.label); });

  const vtkSmartPointer<vtkImageData> image = makeImage<vtkUnsignedCharArray>(thin.grid, isHeld);
  if (m_NullDisplacement)
  {
    setVoxels(m_NullDisplacement, thin.grid, image);
    return;
  }
  vtkMRMLScene* scene = parameters->GetScene();
  m_NullDisplacement = addHiddenVolume<vtkMRMLLabelMapVolumeNode, vtkMRMLLabelMapVolumeDisplayNode>(
    scene, "Preview of null displacement", thin.grid, image);
  vtkNew<vtkMRMLColorTableNode> colors;
  colors->SetName("Preview of null displacement");
  colors->SetTypeToUser();
  fillColorTable({ { Label(1), Tissue{ "null displacement", { 0.45, 0.55, 0.75 } } } }, colors);
  addHidden(scene, colors);
  m_NullDisplacement->GetDisplayNode()->SetAndObserveColorNodeID(colors->GetID());
}

/// The layers of a view are saved before its first overlay, also for views that are added later.
void ScalePreview::putIntoSliceViews(vtkMRMLScene* scene)
{
  for (vtkMRMLSliceCompositeNode* view : sliceViews(scene))
  {
    const int wasModifying = view->StartModify();
    if (m_Before.count(view->GetID()) == 0)
    {
      m_Before[view->GetID()] = { textOf(view->GetForegroundVolumeID()), view->GetForegroundOpacity(),
                                  textOf(view->GetLabelVolumeID()), view->GetLabelOpacity() };
      view->SetForegroundOpacity(overlayOpacity);
    }
    view->SetForegroundVolumeID(m_Scale->GetID());
    if (m_NullDisplacement && textOf(view->GetLabelVolumeID()) != m_NullDisplacement->GetID())
    {
      view->SetLabelVolumeID(m_NullDisplacement->GetID());
      view->SetLabelOpacity(overlayOpacity);
    }
    view->EndModify(wasModifying);
  }
}

void ScalePreview::hideNullDisplacement()
{
  if (!m_NullDisplacement) return;
  vtkMRMLScene* scene = m_NullDisplacement->GetScene();
  for (vtkMRMLSliceCompositeNode* view : scene ? sliceViews(scene) : std::vector<vtkMRMLSliceCompositeNode*>())
  {
    const auto before = m_Before.find(view->GetID());
    if (before == m_Before.end() || textOf(view->GetLabelVolumeID()) != m_NullDisplacement->GetID()) continue;
    view->SetLabelVolumeID(idInScene(scene, before->second.label));
    view->SetLabelOpacity(before->second.labelOpacity);
  }
  vtkMRMLDisplayNode* display = m_NullDisplacement->GetDisplayNode();
  const vtkSmartPointer<vtkMRMLNode> colors = display ? display->GetColorNode() : nullptr;
  removeFromScene(m_NullDisplacement);
  removeFromScene(colors);
  m_NullDisplacement = nullptr;
}

void ScalePreview::hide()
{
  this->hideNullDisplacement();
  if (!m_Scale) return;
  vtkMRMLScene* scene = m_Scale->GetScene();
  for (vtkMRMLSliceCompositeNode* view : scene ? sliceViews(scene) : std::vector<vtkMRMLSliceCompositeNode*>())
  {
    const auto before = m_Before.find(view->GetID());
    if (before == m_Before.end() || textOf(view->GetForegroundVolumeID()) != m_Scale->GetID()) continue;
    view->SetForegroundVolumeID(idInScene(scene, before->second.foreground));
    view->SetForegroundOpacity(before->second.foregroundOpacity);
  }
  removeFromScene(m_Scale);
  m_Scale = nullptr;
  m_Before.clear();
}

MeshSizeEstimate ScalePreview::estimate(vtkMRMLSurgicalPathScaleNode* parameters)
{
  const TissueMap& map = this->tissueMap(parameters->GetNodeReference(Node::TissueMapRole()));
  const Focus focus = focusOf(parameters);
  SurgicalScaleOptions options = scaleOptions(parameters, map.table);
  options.spacing = coarseSpacing(map.grid, options.spacing, estimateVoxels);
  const ScaleField scale = computeSurgicalScale(map, focus.targets, focus.paths, options);
  if (!parameters->WantsNullDisplacement()) return estimateMeshSize(map, scale);
  TissueMap held = map;
  markNullDisplacement(held, focus.targets, focus.paths, nullDisplacementOptions(parameters, map.table));
  return estimateMeshSize(held, scale);
}

} // namespace surgicalmesher
