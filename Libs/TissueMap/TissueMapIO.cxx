// SPDX-License-Identifier: Apache-2.0
#include "TissueMapIO.h"

#include "AvailableMemory.h"
#include "CanonicalGrid.h"
#include "Errors.h"
#include "ImageData.h"
#include "ImageHeader.h"
#include "Parallel.h"
#include "SeparateProcess.h"
#include "TextFile.h"

#include <itkGiplImageIO.h>
#include <itkMetaDataObject.h>
#include <itkMetaImageIO.h>
#include <itkNiftiImageIO.h>
#include <itkNrrdImageIO.h>
#include <itksys/SystemTools.hxx>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <iostream>
#include <limits>
#include <memory>
#include <optional>
#include <type_traits>

namespace surgicalmesher
{

namespace
{

using MetaData = std::map<std::string, std::string>;

/// Tag of a segment, in Slicer's notation key:value|
const char* const nullDisplacementTag = "SurgicalMesher.Role:null displacement|";

constexpr double maximumVoxelCount = 2147483648.0; // 2^31: 4 GB of labels

/// Bytes that a reader may need besides an image's data.
constexpr std::uint64_t memoryOfLibraries = 64 << 20;

/// An image file as it lies in memory after reading, and how to walk it in the order of the canonical grid.
struct Volume : CanonicalGrid
{
  std::string file;
  int components = 1; ///< values per voxel, interleaved
  itk::IOComponentEnum type = itk::IOComponentEnum::UNKNOWNCOMPONENTTYPE;
  std::unique_ptr<char[]> data;
  MetaData metaData;
};

/// Keeps what the image libraries print on C++ streams away from stdout and stderr, which carry progress and errors.
class Silence
{
public:
  Silence() : m_Err(std::cerr.rdbuf(&m_Sink)), m_Out(std::cout.rdbuf(&m_Sink)) {}
  ~Silence()
  {
    std::cerr.rdbuf(m_Err);
    std::cout.rdbuf(m_Out);
  }
  Silence(const Silence&) = delete;
  void operator=(const Silence&) = delete;

private:
  std::stringbuf m_Sink;
  std::streambuf* m_Err;
  std::streambuf* m_Out;
};

const std::string* find(const MetaData& metaData, const std::string& key)
{
  const auto found = metaData.find(key);
  return found == metaData.end() ? nullptr : &found->second;
}

/// The most specific line of what an ITK exception says, without the class and address that it begins with.
std::string reasonOf(const std::exception& error)
{
  const auto* itkError = dynamic_cast<const itk::ExceptionObject*>(&error);
  std::string reason;
  for (const std::string& line : text::splitLines(itkError ? itkError->GetDescription() : error.what()))
  {
    if (!text::trimmed(line).empty()) reason = text::trimmed(line);
  }
  const std::size_t address = reason.find("(0x");
  const std::size_t end = address == std::string::npos ? address : reason.find("): ", address);
  return end == std::string::npos ? reason : reason.substr(end + 3);
}

std::vector<itk::ImageIOBase::Pointer> imageFormats()
{
  return { itk::NrrdImageIO::New().GetPointer(), itk::NiftiImageIO::New().GetPointer(),
           itk::MetaImageIO::New().GetPointer(), itk::GiplImageIO::New().GetPointer() };
}

const char* const formatNames = "NRRD, NIfTI, MetaImage or GIPL";

constexpr double librarysSkew = 0.0057; ///< degrees: what ITK takes for perpendicular, a cosine of 1e-4

/// Whether ITK refuses only the placement of a NIfTI file, for whose sform fileGrid() does without it: ITK finds the
/// axes of small voxels, far origins and lengths in metres not perpendicular. By then it knows all else about the
/// file.
bool isPlacedWithoutLibrary(const std::optional<NiftiHeader>& nifti, const std::string& reason)
{
  return nifti && nifti->sformCode > 0 && nifti->skew < librarysSkew && arePerpendicular(nifti->sformColumns) &&
         reason.find("orthonormal") != std::string::npos;
}

/// Explains what is wrong with a NIfTI header that the library refuses, and what the user can do. Empty for other files
/// and other faults.
std::string niftiAdvice(const std::optional<NiftiHeader>& nifti)
{
  if (!nifti || nifti->sformCode <= 0 || nifti->skew < librarysSkew) return {};
  return "the voxel axes of its sform are not perpendicular to each other (by " +
         text::rounded(std::ceil(nifti->skew * 1000 - 0.5) / 1000, 10) +
         " degrees), as an affine registration leaves them; expected a grid without shear: resample the map, or give "
         "the header a qform, "
         "which counts where the sform has shear";
}

/// Analyze 7.5, which has NIfTI's extensions (.hdr, .img), says neither where its voxels lie nor which side is left.
void refuseAnalyze(const std::string& file)
{
  using Kind = itk::NiftiImageIOEnums::NiftiFileEnum;
  if (itk::NiftiImageIO::New()->DetermineFileType(file.c_str()) == Kind::Analyze75)
    throw InputError(file + ": an Analyze 7.5 image, which does not tell left from right, expected NIfTI");
}

itk::ImageIOBase::Pointer openImage(const std::string& file)
{
  text::requireReadableFile(file);
  requireCredibleDimensions(file);
  const Silence silence;
  refuseAnalyze(file);
  for (const itk::ImageIOBase::Pointer& io : imageFormats())
  {
    try
    {
      if (!io->CanReadFile(file.c_str())) continue;
      io->SetFileName(file);
      io->ReadImageInformation();
      return io;
    }
    catch (const std::exception& error)
    {
      const std::optional<NiftiHeader> nifti = readNiftiHeader(file);
      if (isPlacedWithoutLibrary(nifti, error.what())) return io;
      const std::string advice = niftiAdvice(nifti);
      if (!advice.empty()) throw InputError(file + ": " + advice);
      throw InputError(file + ": the image header cannot be read (" + reasonOf(error) + ")");
    }
  }
  throw InputError(file + ": not an image that can be read, expected " + formatNames);
}

/// Reads the header in a separate process first: ITK's readers trust damaged headers and may crash.
void requireHarmlessHeader(const std::string& file)
{
  constexpr int mostSeconds = 10;
  const auto answer = runInSeparateProcess(
    [&]
    {
      try
      {
        openImage(file);
        return std::string();
      }
      catch (const InputError& error)
      {
        return std::string(error.what());
      }
    },
    mostSeconds);
  if (!answer || !answer->empty()) requireMemory(memoryOfLibraries); // otherwise the cause may be a lack of memory
  if (!answer)
    throw InputError(file + ": the image header is damaged: its reader crashed or did not end within " +
                     std::to_string(mostSeconds) + " s of processor time, or ten times as long by the clock");
  if (!answer->empty()) throw InputError(*answer);
}

/// Throws unless the image is a volume of at most 2^31 voxels with at least one in each direction.
std::array<int, 3> volumeSize(const itk::ImageIOBase& io, const std::string& file)
{
  const unsigned int dimension = io.GetNumberOfDimensions();
  std::string found;
  for (unsigned int axis = 0; axis < dimension; ++axis)
  {
    found += (axis ? " x " : "") + std::to_string(io.GetDimensions(axis));
  }
  const bool isVolume = dimension == 3 || (dimension == 4 && io.GetDimensions(3) == 1);
  if (!isVolume)
  {
    throw InputError(file + ": an image of " + std::to_string(dimension) + " dimensions (" + found + "), expected 3");
  }
  double count = 1;
  for (int axis = 0; axis < 3; ++axis) count *= double(io.GetDimensions(axis));
  if (!(count >= 1 && count <= maximumVoxelCount))
  {
    throw InputError(file + ": a grid of " + found + " voxels, expected 1 to 2^31 voxels");
  }
  std::array<int, 3> size;
  for (int axis = 0; axis < 3; ++axis) size[axis] = int(io.GetDimensions(axis));
  return size;
}

/// The first voxel and the steps to the next one along each axis of the file, in LPS mm.
struct Placement
{
  Vec3 origin;
  std::array<Vec3, 3> columns;
};

/// As the library has it, in the file's units.
Placement librarysPlacement(const itk::ImageIOBase& io)
{
  Placement placement;
  for (int axis = 0; axis < 3; ++axis)
  {
    const std::vector<double> direction = io.GetDirection(axis);
    placement.columns[axis] = io.GetSpacing(axis) * Vec3{ direction[0], direction[1], direction[2] };
    placement.origin[axis] = io.GetOrigin(axis);
  }
  return placement;
}

/// If sform and qform differ, ITK uses the qform unless the sform is that of the scanner; nearly all other programs,
/// and this one, use the sform, in which atlases are aligned, unless its axes are not perpendicular. ITK scales the
/// spacing to mm but, in the version of Debian 12, not the origin.
Placement niftiPlacement(const NiftiHeader& nifti, const itk::ImageIOBase& io)
{
  if (nifti.sformCode > 0 && arePerpendicular(nifti.sformColumns)) return { nifti.sformOrigin, nifti.sformColumns };
  Placement placement = librarysPlacement(io);
  if (nifti.qformCode > 0) placement.origin = nifti.qformOrigin;
  return placement;
}

Placement placementInMm(const itk::ImageIOBase& io, const std::optional<NiftiHeader>& nifti, const std::string& file)
{
  if (nifti) return niftiPlacement(*nifti, io);
  Placement placement = librarysPlacement(io);
  const double unit = millimetresPerUnit(file);
  placement.origin = unit * placement.origin;
  for (Vec3& column : placement.columns) column = unit * column;
  return placement;
}

/// The grid in the order of the file; its axes may be left-handed.
Grid fileGrid(const itk::ImageIOBase& io, const std::optional<NiftiHeader>& nifti, const std::string& file)
{
  Grid grid;
  grid.size = volumeSize(io, file);
  const Placement placement = placementInMm(io, nifti, file);
  grid.origin = placement.origin;
  for (int axis = 0; axis < 3; ++axis)
  {
    grid.spacing[axis] = norm(placement.columns[axis]);
    if (!std::isfinite(grid.origin[axis])) throw InputError(file + ": the origin is not finite");
    if (!(std::isfinite(grid.spacing[axis]) && grid.spacing[axis] > 0))
    {
      throw InputError(file + ": voxel spacing " + text::rounded(grid.spacing[axis], 10) + " along axis " +
                       std::to_string(axis) + ", expected more than 0 mm");
    }
    grid.axes[axis] = placement.columns[axis] / grid.spacing[axis];
  }
  if (!arePerpendicular(grid.axes)) throw InputError(file + ": the voxel axes are not perpendicular to each other");
  grid.axes = orthonormalised(grid.axes);
  return grid;
}

MetaData readMetaData(const itk::ImageIOBase& io)
{
  MetaData metaData;
  for (const std::string& key : io.GetMetaDataDictionary().GetKeys())
  {
    std::string value;
    if (itk::ExposeMetaData(io.GetMetaDataDictionary(), key, value)) metaData[key] = value;
  }
  return metaData;
}

/// An integer type of NIfTI, by the standard's number.
struct NiftiType
{
  int number;
  itk::IOComponentEnum type;
  int bytes;
};

/// The type of the voxels in the file if it is one of integers, which slope and intercept turn into floats in memory.
const NiftiType* niftiInteger(const NiftiHeader& nifti)
{
  using Type = itk::IOComponentEnum;
  static const NiftiType types[] = { { 256, Type::CHAR, 1 },      { 2, Type::UCHAR, 1 },       { 4, Type::SHORT, 2 },
                                     { 512, Type::USHORT, 2 },    { 8, Type::INT, 4 },         { 768, Type::UINT, 4 },
                                     { 1024, Type::LONGLONG, 8 }, { 1280, Type::ULONGLONG, 8 } };
  const auto* found = std::find_if(std::begin(types), std::end(types),
                                   [&](const NiftiType& type) { return type.number == nifti.dataType; });
  return found == std::end(types) ? nullptr : found;
}

/// A slope of 0 means that voxels are not scaled; ITK adds the intercept nevertheless.
void takeUnscaledVoxels(const NiftiHeader& nifti, itk::ImageIOBase& io)
{
  auto* niftiIO = dynamic_cast<itk::NiftiImageIO*>(&io);
  if (!niftiIO || (std::isfinite(nifti.slope) && std::abs(nifti.slope) > 0)) return;
  niftiIO->SetRescaleIntercept(0);
  if (const NiftiType* integer = niftiInteger(nifti)) niftiIO->SetComponentType(integer->type);
}

/// Bytes of the file's data, for NIfTI those before the first voxel included.
std::uint64_t bytesOnDisk(const std::optional<NiftiHeader>& nifti, const Volume& volume, std::size_t bytesInMemory)
{
  const NiftiType* integer = nifti ? niftiInteger(*nifti) : nullptr;
  const std::uint64_t valueCount = volume.grid.voxelCount() * std::uint64_t(volume.components);
  const std::uint64_t voxels = integer ? valueCount * std::uint64_t(integer->bytes) : bytesInMemory;
  return voxels + (nifti ? nifti->bytesBeforeVoxels : 0);
}

Volume readVolume(const std::string& file)
{
  requireHarmlessHeader(file);
  const itk::ImageIOBase::Pointer io = openImage(file);
  Volume volume;
  volume.file = file;
  volume.metaData = readMetaData(*io);
  const bool isNifti = dynamic_cast<const itk::NiftiImageIO*>(io.GetPointer()) != nullptr;
  const std::optional<NiftiHeader> nifti = isNifti ? readNiftiHeader(file) : std::nullopt;
  if (nifti) takeUnscaledVoxels(*nifti, *io);
  static_cast<CanonicalGrid&>(volume) = canonicalGrid(fileGrid(*io, nifti, file));
  volume.components = int(io->GetNumberOfComponents());
  volume.type = io->GetComponentType();

  const unsigned int dimension = io->GetNumberOfDimensions();
  itk::ImageIORegion region(dimension);
  for (unsigned int axis = 0; axis < dimension; ++axis) region.SetSize(axis, io->GetDimensions(axis));
  io->SetIORegion(region);
  const Silence silence;
  const std::size_t valueCount = volume.grid.voxelCount() * volume.components;
  const std::size_t byteCount = valueCount * io->GetComponentSize();
  try
  {
    requireImageData(file, bytesOnDisk(nifti, volume, byteCount), valueCount);
    volume.data.reset(new char[byteCount]);
    io->Read(volume.data.get());
  }
  catch (const InputError&)
  {
    requireMemory(memoryOfLibraries);
    throw;
  }
  catch (const std::bad_alloc&)
  {
    requirePlausibleData(file, byteCount);
    throw;
  }
  catch (const std::exception& error)
  {
    requireMemory(byteCount + memoryOfLibraries);
    throw InputError(file + ": the image data cannot be read, truncated or damaged (" + reasonOf(error) + ")");
  }
  return volume;
}

/// Calls function(const T* data) with the type of the file's values.
template <typename Function>
void visitData(const Volume& volume, Function function)
{
  const auto call = [&](auto zero) { function(reinterpret_cast<const decltype(zero)*>(volume.data.get())); };
  using Type = itk::IOComponentEnum;
  switch (volume.type)
  {
  case Type::UCHAR: return call((unsigned char)0);
  case Type::CHAR: return call((signed char)0);
  case Type::USHORT: return call((unsigned short)0);
  case Type::SHORT: return call(short(0));
  case Type::UINT: return call(0u);
  case Type::INT: return call(0);
  case Type::ULONG: return call(0ul);
  case Type::LONG: return call(0l);
  case Type::ULONGLONG: return call(0ull);
  case Type::LONGLONG: return call(0ll);
  case Type::FLOAT: return call(0.f);
  case Type::DOUBLE: return call(0.);
  default: throw InputError(volume.file + ": voxels of an unknown type, expected integers or floats");
  }
}

/// Returns convert(const T* voxel) of every voxel, in the order of the canonical grid. Of several slices that throw,
/// the exception of the first is rethrown.
template <typename Out, typename Convert>
std::vector<Out> gather(const Volume& volume, Convert convert)
{
  std::vector<Out> values(volume.grid.voxelCount());
  visitData(volume,
            [&](const auto* data)
            {
              const std::array<int, 3>& size = volume.grid.size;
              const auto convertSlice = [&, data](int k)
              {
                Out* out = values.data() + volume.grid.index(0, 0, k);
                for (int j = 0; j < size[1]; ++j)
                {
                  const std::ptrdiff_t row = volume.first + j * volume.stride[1] + k * volume.stride[2];
                  for (int i = 0; i < size[0]; ++i)
                    *out++ = convert(data + (row + i * volume.stride[0]) * volume.components);
                }
              };
              std::vector<std::function<void()>> slices;
              for (int k = 0; k < size[2]; ++k) slices.emplace_back([&, k] { convertSlice(k); });
              runInParallel(slices);
            });
  return values;
}

/// The label that a voxel value stands for; throws InputError for values that are no label.
template <typename T>
Label toLabel(T value, const std::string& file)
{
  const double given = double(value);
  const double nearest = std::round(given);
  const bool isNear = std::is_floating_point_v<T> && std::abs(given - nearest) <= 1e-4;
  const double number = isNear ? nearest : given;
  if (number >= 0 && number <= 65535 && number == double(Label(number))) return Label(number);
  throw InputError(file + ": a voxel of value " + text::rounded(given, 10) +
                   ", expected labels: integers from 0 to 65535");
}

/// One segment of a .seg.nrrd: the voxels of value `value` in layer `layer`.
struct Segment
{
  int layer = 0;
  Label value = 1;
  Tissue tissue;
};

long segmentNumber(const Volume& volume, const std::string& key, long minimum, long maximum, long missing)
{
  const std::string* text = find(volume.metaData, key);
  long number = missing;
  if (text && !text::parseInteger(text::trimmed(*text), minimum, maximum, number))
  {
    throw InputError(volume.file + ": " + key + " is \"" + *text + "\", expected an integer from " +
                     std::to_string(minimum) + " to " + std::to_string(maximum));
  }
  return number;
}

/// The segments that the header lists, in its order; none if the file is no segmentation. Headers from before shared
/// layers name neither layer nor value: segment N then consists of the voxels of value 1 in layer N.
std::vector<Segment> readSegments(const Volume& volume)
{
  std::vector<Segment> segments;
  for (int n = 0; find(volume.metaData, "Segment" + std::to_string(n) + "_ID"); ++n)
  {
    const std::string prefix = "Segment" + std::to_string(n);
    Segment segment;
    segment.layer = int(segmentNumber(volume, prefix + "_Layer", 0, volume.components - 1, n));
    segment.value = Label(segmentNumber(volume, prefix + "_LabelValue", 1, 65535, 1));
    if (segment.layer >= volume.components)
    {
      throw InputError(volume.file + ": " + prefix + " has no layer among the " + std::to_string(volume.components) +
                       " of the file");
    }
    if (const std::string* name = find(volume.metaData, prefix + "_Name")) segment.tissue.name = text::trimmed(*name);
    if (const std::string* color = find(volume.metaData, prefix + "_Color"))
    {
      const std::vector<std::string> words = text::splitWords(*color);
      for (std::size_t c = 0; c < 3 && c < words.size(); ++c) text::parseNumber(words[c], segment.tissue.color[c]);
    }
    const std::string* tags = find(volume.metaData, prefix + "_Tags");
    segment.tissue.isNullDisplacement = tags && tags->find(nullDisplacementTag) != std::string::npos;
    segments.push_back(segment);
  }
  return segments;
}

/// The label of every segment: its value in the file, or, where two layers use the same value, 1, 2, 3 ... in the order
/// of the header.
std::vector<Label> segmentLabels(const std::vector<Segment>& segments, int layers)
{
  std::vector<Label> labels;
  for (const Segment& segment : segments) labels.push_back(segment.value);
  std::vector<Label> sorted = labels;
  std::sort(sorted.begin(), sorted.end());
  const bool areUnique = std::adjacent_find(sorted.begin(), sorted.end()) == sorted.end();
  if (layers > 1 && !areUnique)
  {
    for (std::size_t n = 0; n < labels.size(); ++n) labels[n] = Label(n + 1);
  }
  return labels;
}

/// Several layers become one map; where segments overlap, the later one in the header wins.
std::vector<Label> mergeLayers(const Volume& volume, const std::vector<Segment>& segments,
                               const std::vector<Label>& segmentLabel)
{
  std::vector<std::vector<int>> rank(volume.components); // by layer and value: index of the segment + 1; 0: none
  for (std::size_t n = 0; n < segments.size(); ++n)
  {
    std::vector<int>& layer = rank[segments[n].layer];
    if (layer.size() <= segments[n].value) layer.resize(segments[n].value + 1, 0);
    layer[segments[n].value] = int(n) + 1;
  }
  return gather<Label>(volume,
                       [&](const auto* voxel)
                       {
                         int winner = 0;
                         for (int c = 0; c < volume.components; ++c)
                         {
                           const Label value = toLabel(voxel[c], volume.file);
                           const int candidate = value < rank[c].size() ? rank[c][value] : 0;
                           if (value != 0 && candidate == 0)
                           {
                             throw InputError(volume.file + ": layer " + std::to_string(c) + " has a voxel of value " +
                                              std::to_string(value) + ", which no segment of the header has");
                           }
                           winner = std::max(winner, candidate);
                         }
                         return winner == 0 ? Label(0) : segmentLabel[winner - 1];
                       });
}

itk::ImageIOBase::Pointer imageWriter(const std::string& file)
{
  for (const itk::ImageIOBase::Pointer& io : imageFormats())
  {
    if (io->CanWriteFile(file.c_str())) return io;
  }
  throw InputError(file + ": cannot be written as an image, expected the extension of " + formatNames);
}

void writeVolume(const Grid& grid, itk::IOComponentEnum type, const void* data, const MetaData& metaData,
                 const std::string& file)
{
  const itk::ImageIOBase::Pointer io = imageWriter(file);
  io->SetFileName(file);
  io->SetNumberOfDimensions(3);
  itk::ImageIORegion region(3);
  for (int axis = 0; axis < 3; ++axis)
  {
    io->SetDimensions(axis, grid.size[axis]);
    io->SetSpacing(axis, grid.spacing[axis]);
    io->SetOrigin(axis, grid.origin[axis]);
    io->SetDirection(axis, std::vector<double>{ grid.axes[axis].x, grid.axes[axis].y, grid.axes[axis].z });
    region.SetSize(axis, grid.size[axis]);
  }
  io->SetIORegion(region);
  io->SetPixelType(itk::IOPixelEnum::SCALAR);
  io->SetNumberOfComponents(1);
  io->SetComponentType(type);
  io->SetUseCompression(true);
  for (const auto& entry : metaData) itk::EncapsulateMetaData(io->GetMetaDataDictionary(), entry.first, entry.second);
  const Silence silence;
  try
  {
    io->Write(data);
    // The libraries do not report a full disk.
    requireImageData(file, grid.voxelCount() * io->GetComponentSize(), grid.voxelCount());
  }
  catch (const InputError&)
  {
    throw InputError(file + ": cannot be written whole, expected room for it on the disk");
  }
  catch (const std::exception& error)
  {
    throw InputError(file + ": cannot be written (" + reasonOf(error) + ")");
  }
}

/// Names, colours and tags in the form of Slicer's segmentations.
MetaData segmentMetaData(const TissueTable& table)
{
  MetaData metaData;
  int n = 0;
  for (const auto& entry : table)
  {
    const std::string prefix = "Segment" + std::to_string(n++);
    const std::array<double, 3>& color = entry.second.color;
    metaData[prefix + "_ID"] = "Segment_" + std::to_string(entry.first);
    metaData[prefix + "_LabelValue"] = std::to_string(entry.first);
    metaData[prefix + "_Layer"] = "0";
    metaData[prefix + "_Name"] = entry.second.name.empty() ? std::to_string(entry.first) : entry.second.name;
    metaData[prefix + "_Color"] =
      text::rounded(color[0], 10) + " " + text::rounded(color[1], 10) + " " + text::rounded(color[2], 10);
    if (entry.second.isNullDisplacement) metaData[prefix + "_Tags"] = nullDisplacementTag;
  }
  return metaData;
}

/// Reads one number per voxel; `noun` and `expected` name the expected number in messages.
ScalarImage readNumbers(const std::string& file, const std::string& noun, bool (*isAllowed)(float),
                        const std::string& expected)
{
  const Volume volume = readVolume(file);
  if (volume.components > 1)
    throw InputError(file + ": " + std::to_string(volume.components) + " values per voxel, expected one " + noun);
  ScalarImage image;
  image.grid = volume.grid;
  image.values = gather<float>(volume,
                               [&](const auto* voxel)
                               {
                                 const float value = float(*voxel);
                                 if (isAllowed(value)) return value;
                                 throw InputError(file + ": a voxel of value " + text::rounded(double(*voxel), 10) +
                                                  ", expected " + expected);
                               });
  return image;
}

} // namespace

TissueMap readTissueMap(const std::string& file)
{
  const Volume volume = readVolume(file);
  const std::vector<Segment> segments = readSegments(volume);
  if (volume.components > 1 && segments.empty())
  {
    throw InputError(file + ": " + std::to_string(volume.components) + " values per voxel, expected one label");
  }
  TissueMap map;
  map.grid = volume.grid;
  const std::vector<Label> labels = segmentLabels(segments, volume.components);
  for (std::size_t n = 0; n < segments.size(); ++n) map.table[labels[n]] = segments[n].tissue;
  map.labels = volume.components > 1 ? mergeLayers(volume, segments, labels)
                                     : gather<Label>(volume, [&](const auto* voxel) { return toLabel(*voxel, file); });
  if (std::all_of(map.labels.begin(), map.labels.end(), [](Label label) { return label == 0; }))
  {
    throw InputError(file + ": no voxel but background (label 0), expected at least one tissue");
  }
  return map;
}

bool keepsTissues(const std::string& file) { return itk::NrrdImageIO::New()->CanWriteFile(file.c_str()); }

void writeTissueMap(const TissueMap& map, const std::string& file)
{
  writeVolume(map.grid, itk::IOComponentEnum::USHORT, map.labels.data(), segmentMetaData(map.table), file);
}

ScaleField readScale(const std::string& file)
{
  const auto isLength = [](float value) { return std::isfinite(value) && value > 0; };
  ScalarImage image = readNumbers(file, "edge length", isLength, "edge lengths of more than 0 mm");
  return { image.grid, std::move(image.values) };
}

void writeScale(const ScaleField& scale, const std::string& file)
{
  writeVolume(scale.grid, itk::IOComponentEnum::FLOAT, scale.lengths.data(), {}, file);
}

ScalarImage readImage(const std::string& file)
{
  return readNumbers(
    file, "number", [](float value) { return std::isfinite(value); }, "finite numbers");
}

void writeImage(const ScalarImage& image, const std::string& file)
{
  writeVolume(image.grid, itk::IOComponentEnum::FLOAT, image.values.data(), {}, file);
}

void requireCover(const ScaleField& scale, const Grid& grid, const std::string& scaleFile)
{
  for (int corner = 0; corner < 8; ++corner)
  {
    Vec3 p;
    for (int axis = 0; axis < 3; ++axis)
    {
      p[axis] = ((corner >> axis) & 1 ? grid.size[axis] - 0.5 : -0.5) * grid.spacing[axis];
    }
    const Vec3 world = grid.gridToWorld(p);
    const Vec3 q = scale.grid.worldToGrid(world);
    for (int axis = 0; axis < 3; ++axis)
    {
      constexpr double tolerance = 1e-3; // voxels: headers are rounded
      const double index = q[axis] / scale.grid.spacing[axis];
      if (index >= -0.5 - tolerance && index <= scale.grid.size[axis] - 0.5 + tolerance) continue;
      throw InputError(scaleFile + ": the scale volume leaves out part of the label map, whose corner (" +
                       text::rounded(world.x, 10) + ", " + text::rounded(world.y, 10) + ", " +
                       text::rounded(world.z, 10) + ") mm LPS lies outside, expected it to cover the whole map");
    }
  }
}

} // namespace surgicalmesher
