// SPDX-License-Identifier: Apache-2.0
#include "VTKFiles.h"

#include "AvailableMemory.h"
#include "Errors.h"
#include "HeaderClaims.h"
#include "SeparateProcess.h"
#include "Text.h"
#include "TextFile.h"
#include "VTKErrors.h"

#include <vtkCellArray.h>
#include <vtkFieldData.h>
#include <vtkNew.h>
#include <vtkOBJReader.h>
#include <vtkPLYReader.h>
#include <vtkPolyData.h>
#include <vtkPolyDataReader.h>
#include <vtkSTLReader.h>
#include <vtkStringArray.h>
#include <vtkUnsignedCharArray.h>
#include <vtkUnstructuredGrid.h>
#include <vtkUnstructuredGridReader.h>
#include <vtkXMLDataObjectWriter.h>
#include <vtkXMLPolyDataReader.h>
#include <vtkXMLUnstructuredGridReader.h>
#include <vtkXMLWriter.h>

#include <algorithm>
#include <cstring>
#include <filesystem>
#include <memory>
#include <new>
#include <optional>

namespace surgicalmesher
{
namespace
{

[[noreturn]] void refuse(const std::string& file, const std::string& what) { throw InputError(file + ": " + what); }

std::string listed(const std::vector<std::string>& words)
{
  std::string text;
  for (std::size_t i = 0; i < words.size(); ++i)
    text += (i == 0 ? "" : i + 1 < words.size() ? ", " : " or ") + words[i];
  return text;
}

// ---- in the separate process ----------------------------------------------------------------------------------------

template <class Reader>
vtkPointSet* outputOf(Reader* reader, const std::string& file, const std::string& format)
{
  ErrorCatcher errors;
  try
  {
    reader->Update();
  }
  catch (const std::bad_alloc&)
  {
    refuse(file, "not enough memory for what its " + format + " header promises");
  }
  catch (const std::exception& error) // from containers whose size a damaged header gives
  {
    refuse(file, "not a readable " + format + " file (" + error.what() + ")");
  }
  if (errors.any()) refuse(file, "not a readable " + format + " file (" + errors.message() + ")");
  if (reader->GetErrorCode() != 0) refuse(file, "not a readable " + format + " file");
  return reader->GetOutput();
}

bool titleSaysRAS(const char* title) { return title && std::strstr(title, "SPACE=RAS"); }

bool fieldSaysRAS(vtkDataSet* data)
{
  auto* space = vtkStringArray::SafeDownCast(data->GetFieldData()->GetAbstractArray("SPACE"));
  return space && space->GetNumberOfValues() > 0 && space->GetValue(0) == "RAS";
}

template <class Reader>
VTKFile readXML(const std::string& file, const std::string& format)
{
  vtkNew<Reader> reader;
  reader->SetFileName(file.c_str());
  return { outputOf(reader.Get(), file, format), false };
}

template <class Reader>
VTKFile readLegacy(const std::string& file)
{
  vtkNew<Reader> reader;
  reader->SetFileName(file.c_str());
  reader->ReadAllScalarsOn();
  reader->ReadAllVectorsOn();
  reader->ReadAllTensorsOn();
  reader->ReadAllFieldsOn();
  VTKFile result{ outputOf(reader.Get(), file, "legacy VTK (.vtk)"), false };
  result.ras = titleSaysRAS(reader->GetHeader());
  return result;
}

bool isLegacyGrid(const std::string& file)
{
  ErrorCatcher quiet;
  vtkNew<vtkUnstructuredGridReader> reader;
  reader->SetFileName(file.c_str());
  return reader->IsFileUnstructuredGrid() != 0;
}

VTKFile readSTL(const std::string& file)
{
  vtkNew<vtkSTLReader> reader;
  reader->SetFileName(file.c_str());
  VTKFile result{ outputOf(reader.Get(), file, "STL"), false };
  result.ras = titleSaysRAS(reader->GetHeader());
  if (vtkUnsignedCharArray* header = reader->GetBinaryHeader())
  {
    const std::string title(reinterpret_cast<const char*>(header->GetPointer(0)), header->GetNumberOfValues());
    result.ras = result.ras || titleSaysRAS(title.c_str());
  }
  return result;
}

VTKFile readPLY(const std::string& file)
{
  vtkNew<vtkPLYReader> reader;
  reader->SetFileName(file.c_str());
  VTKFile result{ outputOf(reader.Get(), file, "PLY"), false };
  for (vtkIdType i = 0; i < reader->GetComments()->GetNumberOfValues(); ++i)
    result.ras = result.ras || titleSaysRAS(reader->GetComments()->GetValue(i).c_str());
  return result;
}

VTKFile readOBJ(const std::string& file)
{
  vtkNew<vtkOBJReader> reader;
  reader->SetFileName(file.c_str());
  return { outputOf(reader.Get(), file, "Wavefront OBJ"), false };
}

VTKFile readByExtension(const std::string& file)
{
  const std::string extension = text::extensionOf(file);
  if (extension == ".vtp") return readXML<vtkXMLPolyDataReader>(file, "VTK XML polygonal data (.vtp)");
  if (extension == ".vtu") return readXML<vtkXMLUnstructuredGridReader>(file, "VTK XML unstructured grid (.vtu)");
  if (extension == ".stl") return readSTL(file);
  if (extension == ".ply") return readPLY(file);
  if (extension == ".obj") return readOBJ(file);
  return isLegacyGrid(file) ? readLegacy<vtkUnstructuredGridReader>(file) : readLegacy<vtkPolyDataReader>(file);
}

template <class Array>
void requireValidIds(Array* offsets, Array* ids, vtkIdType pointCount, const std::string& file)
{
  for (vtkIdType i = 0; i < offsets->GetNumberOfValues(); ++i)
  {
    const auto lowest = i == 0 ? 0 : offsets->GetValue(i - 1);
    if (offsets->GetValue(i) < lowest || offsets->GetValue(i) > ids->GetNumberOfValues())
      refuse(file, "cell offsets are damaged at cell " + std::to_string(i));
  }
  for (vtkIdType i = 0; i < ids->GetNumberOfValues(); ++i)
  {
    if (ids->GetValue(i) >= 0 && ids->GetValue(i) < pointCount) continue;
    refuse(file, "a cell refers to point " + std::to_string(ids->GetValue(i)) + ", but there are " +
                   std::to_string(pointCount) + " points");
  }
}

void requireValidIds(vtkCellArray* cells, vtkIdType pointCount, const std::string& file)
{
  if (cells->IsStorage64Bit())
    requireValidIds(cells->GetOffsetsArray64(), cells->GetConnectivityArray64(), pointCount, file);
  else requireValidIds(cells->GetOffsetsArray32(), cells->GetConnectivityArray32(), pointCount, file);
}

// ---- from one process to the other ----------------------------------------------------------------------------------

/// Last letter of the answer of the separate process. It follows the data as XML and a letter for their coordinates:
/// RAS ('r') or LPS ('l').
enum Answer : char
{
  Surface = 's',
  Grid = 'g',
  Refused = '!' ///< follows the error message
};

std::string asXML(vtkDataObject* data, const std::string& file)
{
  const auto writer = vtkSmartPointer<vtkXMLWriter>::Take(vtkXMLDataObjectWriter::NewWriter(data->GetDataObjectType()));
  writer->SetInputDataObject(data);
  writer->SetDataModeToAppended();
  writer->EncodeAppendedDataOff();
  writer->SetCompressorTypeToNone();
  writer->SetHeaderTypeToUInt64();
  writer->WriteToOutputStringOn();
  ErrorCatcher errors;
  if (!writer->Write() || errors.any()) refuse(file, "its data contradict one another");
  return writer->GetOutputString();
}

std::string answerFor(const std::string& file)
{
  try
  {
    requireCredibleHeader(file);
    const VTKFile read = readByExtension(file);
    requireValidCells(read.data, file);
    std::string answer = asXML(read.data, file);
    answer.push_back(read.ras || fieldSaysRAS(read.data) ? 'r' : 'l');
    answer.push_back(vtkPolyData::SafeDownCast(read.data) ? Surface : Grid);
    return answer;
  }
  catch (const InputError& error)
  {
    return std::string(error.what()) + char(Refused);
  }
}

template <class Reader>
vtkSmartPointer<vtkPointSet> fromXML(const std::string& text, const std::string& file)
{
  vtkNew<Reader> reader;
  reader->ReadFromInputStringOn();
  reader->SetInputString(text);
  return outputOf(reader.Get(), file, "VTK");
}

std::uintmax_t sizeOf(const std::string& file)
{
  std::error_code error;
  const std::uintmax_t bytes = std::filesystem::file_size(file, error);
  return error ? 0 : bytes;
}

/// The least memory to read a sound file, including what the libraries need.
std::uint64_t memoryFor(const std::string& file) { return (std::uint64_t(128) << 20) + 4 * sizeOf(file); }

VTKFile fileOf(std::optional<std::string> answer, const std::string& file, int mostSeconds)
{
  if (!answer || answer->size() < 2)
    refuse(file, "damaged: its reader crashed or did not end within " + std::to_string(mostSeconds) +
                   " s of processor time, or ten times as long by the clock");
  if (answer->back() == Refused) throw InputError(answer->substr(0, answer->size() - 1));
  const bool isGrid = answer->back() == Grid, ras = answer->end()[-2] == 'r';
  answer->resize(answer->size() - 2);
  return { isGrid ? fromXML<vtkXMLUnstructuredGridReader>(*answer, file) : fromXML<vtkXMLPolyDataReader>(*answer, file),
           ras };
}

int mostSecondsFor(const std::string& file) { return 10 + int(std::min<std::uintmax_t>(sizeOf(file) >> 21, 1u << 20)); }

/// Distinguishes lack of memory from a damaged file: VTK's readers and writers that run out of memory crash, or report
/// the same errors as for damaged files.
VTKFile fileOrNoMemory(SeparateProcess& reader, const std::string& file, int mostSeconds)
{
  try
  {
    return fileOf(reader.answer(), file, mostSeconds);
  }
  catch (const InputError&)
  {
    requireMemory(memoryFor(file));
    throw;
  }
}

} // namespace

void requireValidCells(vtkPointSet* data, const std::string& name)
{
  const vtkIdType count = data->GetNumberOfPoints();
  if (auto* grid = vtkUnstructuredGrid::SafeDownCast(data))
  {
    requireValidIds(grid->GetCells(), count, name);
    return;
  }
  auto* surface = vtkPolyData::SafeDownCast(data);
  for (vtkCellArray* cells : { surface->GetVerts(), surface->GetLines(), surface->GetPolys(), surface->GetStrips() })
    requireValidIds(cells, count, name);
}

VTKFile readVTKFile(const std::string& file, const std::vector<std::string>& extensions)
{
  return beginReadingVTKFile(file, extensions)();
}

std::function<VTKFile()> beginReadingVTKFile(const std::string& file, const std::vector<std::string>& extensions)
{
  text::requireReadableFile(file);
  const std::string extension = text::extensionOf(file);
  if (std::find(extensions.begin(), extensions.end(), extension) == extensions.end())
    refuse(file, "unknown kind of file '" + extension + "', expected " + listed(extensions));
  const int mostSeconds = mostSecondsFor(file);
  const auto reader = std::make_shared<SeparateProcess>([file] { return answerFor(file); }, mostSeconds);
  return [file, reader, mostSeconds] { return fileOrNoMemory(*reader, file, mostSeconds); };
}

} // namespace surgicalmesher
