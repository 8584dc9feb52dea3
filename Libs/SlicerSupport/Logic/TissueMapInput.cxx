// SPDX-License-Identifier: Apache-2.0
#include "TissueMapInput.h"

#include "CanonicalGrid.h"
#include "Errors.h"
#include "HostDifferences.h"
#include "SceneNodes.h"
#include "TissueColors.h"

#include <vtkMRMLColorTableNode.h>
#include <vtkMRMLLabelMapVolumeDisplayNode.h>
#include <vtkMRMLLabelMapVolumeNode.h>
#include <vtkMRMLScene.h>
#include <vtkMRMLSegmentationNode.h>
#include <vtkMRMLTransformNode.h>
#include <vtkOrientedImageData.h>
#include <vtkOrientedImageDataResample.h>
#include <vtkSegment.h>
#include <vtkSegmentation.h>
#include <vtkSegmentationConverter.h>

#include <vtkGeneralTransform.h>
#include <vtkImageData.h>
#include <vtkMatrix4x4.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkSetGet.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <sstream>

namespace surgicalmesher
{

namespace
{

constexpr int largestLabel = 65535;
constexpr const char* heldLabels = "SurgicalMesher.NullDisplacementLabels"; // attribute of a label map
constexpr const char* roleTag = "SurgicalMesher.Role";                      // tag of a segment

//--- Segmentations ----------------------------------------------------------

const char* binaryLabelmap() { return vtkSegmentationConverter::GetSegmentationBinaryLabelmapRepresentationName(); }

/// Whether all representations of a segment, of whatever kind, are empty.
bool isEmpty(vtkSegment* segment)
{
  std::vector<std::string> names;
  segment->GetContainedRepresentationNames(names);
  for (const std::string& name : names)
  {
    vtkDataObject* data = segment->GetRepresentation(name);
    if (auto* image = vtkOrientedImageData::SafeDownCast(data))
    {
      if (!image->IsEmpty() && image->GetScalarRange()[1] > 0) return false;
    }
    else if (auto* mesh = vtkPolyData::SafeDownCast(data))
    {
      if (mesh->GetNumberOfCells() > 0) return false;
    }
  }
  return true;
}

TissueMapProblem checkSegmentation(vtkMRMLSegmentationNode* node)
{
  vtkSegmentation* segmentation = node->GetSegmentation();
  if (!segmentation || segmentation->GetNumberOfSegments() == 0) return TissueMapProblem::NoSegment;
  bool isAllEmpty = true;
  for (int n = 0; n < segmentation->GetNumberOfSegments() && isAllEmpty; ++n)
  {
    isAllEmpty = isEmpty(segmentation->GetNthSegment(n));
  }
  if (isAllEmpty) return TissueMapProblem::OnlyBackground;
  const std::string geometry =
    segmentation->GetConversionParameter(vtkSegmentationConverter::GetReferenceImageGeometryParameterName());
  if (geometry.empty() && !segmentation->ContainsRepresentation(binaryLabelmap()))
    return TissueMapProblem::NoReferenceGeometry;
  return TissueMapProblem::None;
}

/// Labels increase with the order of the segments, so that the larger label wins where two segments overlap.
template <typename T>
void paintLayer(vtkImageData* layer, const std::map<int, int>& newLabels, vtkImageData* merged, T*)
{
  int extent[6];
  std::copy_n(layer->GetExtent(), 6, extent);
  const int* bounds = merged->GetExtent();
  for (int axis = 0; axis < 3; ++axis)
  {
    extent[2 * axis] = std::max(extent[2 * axis], bounds[2 * axis]);
    extent[2 * axis + 1] = std::min(extent[2 * axis + 1], bounds[2 * axis + 1]);
    if (extent[2 * axis] > extent[2 * axis + 1]) return;
  }
  for (int k = extent[4]; k <= extent[5]; ++k)
  {
    for (int j = extent[2]; j <= extent[3]; ++j)
    {
      const T* in = static_cast<const T*>(layer->GetScalarPointer(extent[0], j, k));
      auto* out = static_cast<unsigned short*>(merged->GetScalarPointer(extent[0], j, k));
      int lastValue = 0;
      int lastLabel = 0;
      for (int i = extent[0]; i <= extent[1]; ++i, ++in, ++out)
      {
        const int value = int(*in);
        if (value == 0) continue;
        if (value != lastValue)
        {
          const auto found = newLabels.find(value);
          lastValue = value;
          lastLabel = found == newLabels.end() ? 0 : found->second;
        }
        if (lastLabel > *out) *out = static_cast<unsigned short>(lastLabel);
      }
    }
  }
}

void paintLayer(vtkImageData* layer, const std::map<int, int>& newLabels, vtkImageData* merged)
{
  switch (layer->GetScalarType())
  {
    vtkTemplateMacro(paintLayer(layer, newLabels, merged, static_cast<VTK_TT*>(nullptr)));
  }
}

/// Returns, for each image shared by segments, the labels by value in the image; the label of the n-th segment is n +
/// 1.
std::map<vtkOrientedImageData*, std::map<int, int>> layersOf(vtkSegmentation* segmentation)
{
  std::map<vtkOrientedImageData*, std::map<int, int>> layers;
  for (int n = 0; n < segmentation->GetNumberOfSegments(); ++n)
  {
    vtkSegment* segment = segmentation->GetNthSegment(n);
    auto* image = vtkOrientedImageData::SafeDownCast(segment->GetRepresentation(binaryLabelmap()));
    if (image && !image->IsEmpty()) layers[image][segment->GetLabelValue()] = n + 1;
  }
  return layers;
}

/// Returns all segments in one image of the reference geometry; null if Slicer cannot convert them.
vtkSmartPointer<vtkOrientedImageData> mergeSegments(vtkSegmentation* source)
{
  vtkSmartPointer<vtkSegmentation> segmentation = source;
  if (!source->ContainsRepresentation(binaryLabelmap()))
  {
    segmentation = vtkSmartPointer<vtkSegmentation>::New(); // the conversion would be kept in the user's node
    segmentation->DeepCopy(source);
    if (!segmentation->CreateRepresentation(binaryLabelmap())) return nullptr;
  }
  const std::string geometry = segmentation->DetermineCommonLabelmapGeometry(vtkSegmentation::EXTENT_REFERENCE_GEOMETRY,
                                                                             std::vector<std::string>());
  auto merged = vtkSmartPointer<vtkOrientedImageData>::New();
  if (geometry.empty() ||
      !vtkSegmentationConverter::DeserializeImageGeometry(geometry, merged, true, VTK_UNSIGNED_SHORT, 1))
    return nullptr;
  merged->GetPointData()->GetScalars()->Fill(0);
  vtkNew<vtkMatrix4x4> imageToWorld;
  merged->GetImageToWorldMatrix(imageToWorld);
  for (const auto& entry : layersOf(segmentation))
  {
    vtkSmartPointer<vtkOrientedImageData> layer = entry.first;
    if (!vtkOrientedImageDataResample::DoGeometriesMatch(merged, layer))
    {
      layer = vtkSmartPointer<vtkOrientedImageData>::New();
      if (!vtkOrientedImageDataResample::ResampleOrientedImageToReferenceGeometry(entry.first, imageToWorld, layer))
        return nullptr;
    }
    paintLayer(layer, entry.second, merged);
  }
  return merged;
}

/// Volume nodes hold images of unit spacing that begin at voxel (0, 0, 0); the rest is in a matrix.
void setImage(vtkMRMLLabelMapVolumeNode* node, vtkOrientedImageData* oriented)
{
  const int* extent = oriented->GetExtent();
  vtkNew<vtkMatrix4x4> matrix;
  oriented->GetImageToWorldMatrix(matrix);
  const double corner[4] = { double(extent[0]), double(extent[2]), double(extent[4]), 1 };
  double origin[4];
  matrix->MultiplyPoint(corner, origin);
  for (int row = 0; row < 3; ++row) matrix->SetElement(row, 3, origin[row]);
  vtkNew<vtkImageData> image;
  image->SetDimensions(oriented->GetDimensions());
  image->GetPointData()->SetScalars(oriented->GetPointData()->GetScalars());
  node->SetAndObserveImageData(image);
  node->SetIJKToRASMatrix(matrix);
}

//--- Label maps -------------------------------------------------------------

std::array<Vec3, 3> columnsOf(vtkMatrix4x4* matrix)
{
  std::array<Vec3, 3> columns;
  for (int axis = 0; axis < 3; ++axis)
  {
    for (int row = 0; row < 3; ++row) columns[axis][row] = matrix->GetElement(row, axis);
  }
  return columns;
}

TissueMapProblem checkLabelMap(vtkMRMLLabelMapVolumeNode* node)
{
  vtkImageData* image = node->GetImageData();
  if (!image || image->GetNumberOfPoints() == 0 || !image->GetPointData()->GetScalars())
    return TissueMapProblem::NoVoxels;
  const double* range = image->GetScalarRange();
  if (range[0] < 0 || range[1] > largestLabel) return TissueMapProblem::NegativeLabels;
  return range[1] > 0 ? TissueMapProblem::None : TissueMapProblem::OnlyBackground;
}

/// A linear transform may shear the voxels, which no image file can represent.
TissueMapProblem checkTransform(vtkMRMLTransformableNode* node)
{
  vtkMRMLTransformNode* parent = node->GetParentTransformNode();
  if (!parent || !parent->IsTransformToWorldLinear()) return TissueMapProblem::None;
  vtkNew<vtkMatrix4x4> matrix;
  if (auto* volume = vtkMRMLVolumeNode::SafeDownCast(node)) volume->GetIJKToRASMatrix(matrix);
  vtkNew<vtkMatrix4x4> toWorld;
  parent->GetMatrixTransformToWorld(toWorld);
  vtkMatrix4x4::Multiply4x4(toWorld, matrix, matrix);
  return arePerpendicular(columnsOf(matrix)) ? TissueMapProblem::None : TissueMapProblem::ShearingTransform;
}

/// Returns a label map that is in no scene, or null and the problem in `problem`.
vtkSmartPointer<vtkMRMLLabelMapVolumeNode> makeLabelMap(vtkMRMLNode* input, TissueMapProblem& problem)
{
  problem = checkTissueMap(input);
  if (problem != TissueMapProblem::None) return nullptr;
  auto labelMap = vtkSmartPointer<vtkMRMLLabelMapVolumeNode>::New();
  labelMap->SetName(input->GetName());
  if (auto* volume = vtkMRMLLabelMapVolumeNode::SafeDownCast(input))
  {
    vtkNew<vtkMatrix4x4> matrix;
    volume->GetIJKToRASMatrix(matrix);
    labelMap->SetAndObserveImageData(volume->GetImageData());
    labelMap->SetIJKToRASMatrix(matrix);
  }
  else
  {
    const vtkSmartPointer<vtkOrientedImageData> merged =
      mergeSegments(vtkMRMLSegmentationNode::SafeDownCast(input)->GetSegmentation());
    if (!merged) problem = TissueMapProblem::NotExported;
    else if (merged->GetScalarRange()[1] <= 0) problem = TissueMapProblem::OnlyBackground;
    if (problem != TissueMapProblem::None) return nullptr;
    setImage(labelMap, merged);
  }
  vtkMRMLTransformNode* parent = vtkMRMLTransformableNode::SafeDownCast(input)->GetParentTransformNode();
  if (!parent) return labelMap;
  if (parent->IsTransformToWorldLinear())
  {
    vtkNew<vtkMatrix4x4> toWorld;
    parent->GetMatrixTransformToWorld(toWorld);
    labelMap->ApplyTransformMatrix(toWorld);
  }
  else
  {
    vtkNew<vtkGeneralTransform> toWorld;
    parent->GetTransformToWorld(toWorld);
    labelMap->ApplyTransform(toWorld); // resamples into a new image, by nearest voxel
  }
  vtkNew<vtkMatrix4x4> matrix;
  labelMap->GetIJKToRASMatrix(matrix);
  if (arePerpendicular(columnsOf(matrix))) return labelMap;
  problem = TissueMapProblem::ShearingTransform;
  return nullptr;
}

//--- Names and colours ------------------------------------------------------

TissueTable colorTableOf(vtkMRMLLabelMapVolumeNode* volume)
{
  TissueTable table;
  vtkMRMLDisplayNode* display = volume->GetDisplayNode();
  vtkMRMLColorNode* colors = display ? display->GetColorNode() : nullptr;
  const int count = colors ? std::min(colors->GetNumberOfColors(), largestLabel + 1) : 0;
  for (int label = 1; label < count; ++label)
  {
    double rgba[4];
    if (!host::hasColorName(colors, label) || !colors->GetColor(label, rgba)) continue;
    Tissue tissue;
    tissue.name = colors->GetColorName(label);
    std::copy_n(rgba, 3, tissue.color.begin());
    table[Label(label)] = tissue;
  }
  const char* held = volume->GetAttribute(heldLabels);
  std::istringstream labels(held ? held : "");
  for (std::string word; std::getline(labels, word, ',');)
  {
    const long label = std::strtol(word.c_str(), nullptr, 10);
    if (label > 0 && label <= largestLabel) table[Label(label)].isNullDisplacement = true;
  }
  return table;
}

vtkSmartPointer<vtkMRMLColorTableNode> makeColorTable(const TissueTable& table, const char* name)
{
  if (table.empty()) return nullptr;
  auto colors = vtkSmartPointer<vtkMRMLColorTableNode>::New();
  colors->SetName(name);
  colors->SetTypeToUser();
  fillColorTable(table, colors);
  return colors;
}

const char* sentence(TissueMapProblem problem)
{
  switch (problem)
  {
  case TissueMapProblem::None: return "";
  case TissueMapProblem::NothingChosen: return "no tissue map is chosen";
  case TissueMapProblem::NotATissueMap: return "the node is neither a label map nor a segmentation";
  case TissueMapProblem::NoSegment: return "the segmentation has no segment";
  case TissueMapProblem::NoVoxels: return "the label map has no voxels";
  case TissueMapProblem::OnlyBackground: return "no voxel belongs to a tissue";
  case TissueMapProblem::NoReferenceGeometry: return "the voxel grid of the segmentation is unknown";
  case TissueMapProblem::ShearingTransform: return "the transform shears the voxels";
  case TissueMapProblem::NegativeLabels: return "voxels are not whole numbers from 0 to 65535";
  case TissueMapProblem::NotExported: return "the segmentation cannot be converted to a label map";
  }
  return "";
}

Grid gridOf(vtkMRMLLabelMapVolumeNode* node)
{
  vtkNew<vtkMatrix4x4> matrix;
  node->GetIJKToRASMatrix(matrix);
  const Vec3 toLPS{ -1, -1, 1 };
  Grid grid;
  node->GetImageData()->GetDimensions(grid.size.data());
  const std::array<Vec3, 3> columns = columnsOf(matrix);
  for (int axis = 0; axis < 3; ++axis)
  {
    grid.spacing[axis] = norm(columns[axis]);
    grid.origin[axis] = toLPS[axis] * matrix->GetElement(axis, 3);
    for (int row = 0; row < 3; ++row) grid.axes[axis][row] = toLPS[row] * columns[axis][row] / grid.spacing[axis];
  }
  grid.axes = orthonormalised(grid.axes);
  return grid;
}

/// Returns false if a value is not a label.
template <typename T>
bool gatherLabels(const T* voxels, const CanonicalGrid& order, std::vector<Label>& labels)
{
  const std::array<int, 3>& size = order.grid.size;
  labels.resize(order.grid.voxelCount());
  Label* out = labels.data();
  for (int k = 0; k < size[2]; ++k)
  {
    for (int j = 0; j < size[1]; ++j)
    {
      const T* in = voxels + (order.first + j * order.stride[1] + k * order.stride[2]);
      for (int i = 0; i < size[0]; ++i, ++out)
      {
        const double value = double(in[i * order.stride[0]]);
        if (!(value >= 0 && value <= largestLabel && value == std::floor(value))) return false;
        *out = Label(value);
      }
    }
  }
  return true;
}

} // namespace

TissueMapProblem checkTissueMap(vtkMRMLNode* input)
{
  if (!input) return TissueMapProblem::NothingChosen;
  auto* volume = vtkMRMLLabelMapVolumeNode::SafeDownCast(input);
  auto* segmentation = vtkMRMLSegmentationNode::SafeDownCast(input);
  if (!volume && !segmentation) return TissueMapProblem::NotATissueMap;
  const TissueMapProblem problem = volume ? checkLabelMap(volume) : checkSegmentation(segmentation);
  return problem == TissueMapProblem::None ? checkTransform(vtkMRMLTransformableNode::SafeDownCast(input)) : problem;
}

vtkMTimeType tissueMapTime(vtkMRMLNode* input)
{
  vtkMTimeType time = 0;
  const auto include = [&time](vtkObject* object) { time = std::max(time, object ? object->GetMTime() : 0); };
  if (auto* volume = vtkMRMLLabelMapVolumeNode::SafeDownCast(input))
  {
    include(volume);
    include(volume->GetImageData());
  }
  auto* node = vtkMRMLSegmentationNode::SafeDownCast(input);
  vtkSegmentation* segmentation = node ? node->GetSegmentation() : nullptr;
  include(segmentation);
  for (int n = 0; segmentation && n < segmentation->GetNumberOfSegments(); ++n)
  {
    vtkSegment* segment = segmentation->GetNthSegment(n);
    include(segment);
    std::vector<std::string> names;
    segment->GetContainedRepresentationNames(names);
    for (const std::string& name : names) include(segment->GetRepresentation(name));
  }
  auto* transformable = vtkMRMLTransformableNode::SafeDownCast(input);
  vtkMRMLTransformNode* parent = transformable ? transformable->GetParentTransformNode() : nullptr;
  return parent ? std::max(time, parent->GetTransformToWorldMTime()) : time;
}

TissueMapNodes makeTissueMapNodes(vtkMRMLNode* input)
{
  TissueMapNodes nodes;
  nodes.labelMap = makeLabelMap(input, nodes.problem);
  if (!nodes.labelMap) return nodes;
  addHidden(input->GetScene(), nodes.labelMap);
  nodes.colors = makeColorTable(tissueTable(input), input->GetName());
  if (nodes.colors) addHidden(input->GetScene(), nodes.colors);
  return nodes;
}

TissueTable tissueTable(vtkMRMLNode* input)
{
  if (auto* volume = vtkMRMLLabelMapVolumeNode::SafeDownCast(input)) return colorTableOf(volume);
  TissueTable table;
  auto* node = vtkMRMLSegmentationNode::SafeDownCast(input);
  vtkSegmentation* segmentation = node ? node->GetSegmentation() : nullptr;
  const int count = segmentation ? std::min(segmentation->GetNumberOfSegments(), largestLabel) : 0;
  for (int n = 0; n < count; ++n)
  {
    vtkSegment* segment = segmentation->GetNthSegment(n);
    Tissue tissue;
    tissue.name = segment->GetName() ? segment->GetName() : "";
    std::copy_n(segment->GetColor(), 3, tissue.color.begin());
    std::string role;
    tissue.isNullDisplacement = segment->GetTag(roleTag, role) && role == "null displacement";
    table[Label(n + 1)] = tissue;
  }
  return table;
}

void keepNullDisplacement(vtkMRMLLabelMapVolumeNode* labelMap, const TissueTable& table)
{
  const std::string labels = nullDisplacementLabels(table);
  labelMap->SetAttribute(heldLabels, labels.empty() ? nullptr : labels.c_str());
}

std::string nullDisplacementLabels(const TissueTable& table)
{
  std::string labels;
  for (const auto& [label, tissue] : table)
    if (tissue.isNullDisplacement) labels += (labels.empty() ? "" : ",") + std::to_string(label);
  return labels;
}

TissueMap readTissueMap(vtkMRMLNode* input)
{
  TissueMapProblem problem;
  const vtkSmartPointer<vtkMRMLLabelMapVolumeNode> node = makeLabelMap(input, problem);
  if (!node) throw InputError(sentence(problem));
  const CanonicalGrid order = canonicalGrid(gridOf(node));
  TissueMap map;
  map.grid = order.grid;
  vtkImageData* image = node->GetImageData();
  bool areLabels = image->GetNumberOfScalarComponents() == 1;
  if (areLabels)
  {
    switch (image->GetScalarType())
    {
      vtkTemplateMacro(areLabels =
                         gatherLabels(static_cast<const VTK_TT*>(image->GetScalarPointer()), order, map.labels));
    }
  }
  if (!areLabels) throw InputError(sentence(TissueMapProblem::NegativeLabels));
  map.table = tissueTable(input);
  return map;
}

} // namespace surgicalmesher
