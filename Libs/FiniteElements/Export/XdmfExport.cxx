// SPDX-License-Identifier: Apache-2.0
#include "XdmfExport.h"

#include "Errors.h"
#include "SetTags.h"
#include "TextFile.h"

#include <vtk_hdf5.h>

#include <algorithm>
#include <filesystem>
#include <type_traits>

namespace surgicalmesher
{
namespace
{

/// An HDF5 handle that is closed on destruction.
class Handle
{
public:
  Handle(hid_t id, herr_t (*close)(hid_t)) : m_Id(id), m_Close(close)
  {
    if (id < 0) throw EngineError("HDF5: no memory for the exported mesh");
  }
  ~Handle() { m_Close(m_Id); }
  Handle(const Handle&) = delete;
  Handle& operator=(const Handle&) = delete;

  operator hid_t() const { return m_Id; }

private:
  hid_t m_Id;
  herr_t (*m_Close)(hid_t);
};

void require(bool done)
{
  if (!done) throw EngineError("HDF5: the exported mesh can't be composed");
}

/// An HDF5 file in memory, so that disk failures are reported by writeBytes() alone.
class MemoryFile
{
public:
  MemoryFile() : m_Access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose), m_File(create(m_Access), H5Fclose) {}

  /// Adds `values` as a table of `columns` columns, or as a list if there is only one column.
  template <class Value>
  void add(const std::string& name, const Value* values, std::size_t rows, int columns)
  {
    static_assert(std::is_same_v<Value, double> || std::is_same_v<Value, std::int32_t>);
    const hid_t memory = std::is_same_v<Value, double> ? H5T_NATIVE_DOUBLE : H5T_NATIVE_INT32;
    const hid_t stored = std::is_same_v<Value, double> ? H5T_IEEE_F64LE : H5T_STD_I32LE;
    const hsize_t size[2]{ rows, static_cast<hsize_t>(columns) };
    const Handle space(H5Screate_simple(columns == 1 ? 1 : 2, size, nullptr), H5Sclose);
    const Handle plain(H5Pcreate(H5P_DATASET_CREATE), H5Pclose);
    require(H5Pset_obj_track_times(plain, false) >= 0); // the same content yields the same bytes
    const Handle set(H5Dcreate2(m_File, name.c_str(), stored, space, H5P_DEFAULT, plain, H5P_DEFAULT), H5Dclose);
    require(H5Dwrite(set, memory, H5S_ALL, H5S_ALL, H5P_DEFAULT, values) >= 0);
  }

  std::string bytes() const
  {
    require(H5Fflush(m_File, H5F_SCOPE_GLOBAL) >= 0);
    const auto size = H5Fget_file_image(m_File, nullptr, 0);
    require(size > 0);
    std::string image(static_cast<std::size_t>(size), '\0');
    require(H5Fget_file_image(m_File, image.data(), image.size()) == size);
    return image;
  }

private:
  static hid_t create(hid_t access)
  {
    require(H5Pset_fapl_core(access, std::size_t(1) << 20, false) >= 0);
    return H5Fcreate("memory", H5F_ACC_TRUNC, H5P_DEFAULT, access);
  }

  Handle m_Access, m_File;
};

std::string escaped(const std::string& text)
{
  std::string result;
  for (const char c : text)
  {
    if (c == '&') result += "&amp;";
    else if (c == '<') result += "&lt;";
    else result += c;
  }
  return result;
}

/// Name and number of a cell type in XDMF.
struct XdmfType
{
  const char* name;
  std::int32_t number;
};

XdmfType typeOf(const Cell& cell, int dimension)
{
  switch (cell.size())
  {
  case 2: return { "Polyline", 2 };
  case 3: return { "Triangle", 4 };
  case 4: return dimension == 2 ? XdmfType{ "Quadrilateral", 5 } : XdmfType{ "Tetrahedron", 6 };
  case 6: return dimension == 2 ? XdmfType{ "Triangle_6", 36 } : XdmfType{ "Wedge", 8 };
  case 10: return { "Tetrahedron_10", 38 };
  default: return { "Hexahedron", 9 };
  }
}

/// An .xdmf file with one grid, and the .h5 file that it refers to.
class XdmfFile
{
public:
  XdmfFile(const std::string& file, const std::string& grid) : m_Xdmf(file), m_Heavy(file)
  {
    m_Heavy.replace_extension(".h5");
    m_Text =
      "<?xml version=\"1.0\"?>\n<Xdmf Version=\"3.0\">\n<Domain>\n<Grid Name=\"" + grid + "\" GridType=\"Uniform\">\n";
  }

  /// Adds elements (dimension 3), faces (2) or edges (1): a table if all have one type, otherwise ("Mixed") a list in
  /// which the type number precedes each cell.
  void topology(const std::vector<Cell>& cells, int dimension)
  {
    const bool isMixed =
      std::any_of(cells.begin(), cells.end(), [&](const Cell& cell) { return cell.size() != cells[0].size(); });
    std::vector<std::int32_t> numbers;
    for (const Cell& cell : cells)
    {
      if (isMixed) numbers.push_back(typeOf(cell, dimension).number);
      const Cell ordered = dimension == 3 ? inOrderOfVtk(cell) : cell;
      numbers.insert(numbers.end(), ordered.begin(), ordered.end());
    }
    const std::size_t columns = isMixed || cells.empty() ? 1 : cells[0].size();
    const char* type = isMixed ? "Mixed" : cells.empty() ? "Triangle" : typeOf(cells[0], dimension).name;
    m_Text += std::string("<Topology TopologyType=\"") + type + "\"" + (columns == 2 ? " NodesPerElement=\"2\"" : "") +
              " NumberOfElements=\"" + std::to_string(cells.size()) + "\">" +
              item("topology", numbers.data(), numbers.size() / columns, static_cast<int>(columns)) + "</Topology>\n";
  }

  void geometry(const std::vector<Vec3>& points)
  {
    m_Text +=
      "<Geometry GeometryType=\"XYZ\">" + item("geometry", &points.data()->x, points.size(), 3) + "</Geometry>\n";
  }

  template <class Value>
  void attribute(const std::string& name, const char* center, const std::vector<Value>& values)
  {
    m_Text += "<Attribute Name=\"" + name + "\" AttributeType=\"Scalar\" Center=\"" + center + "\">" +
              item(name, values.data(), values.size(), 1) + "</Attribute>\n";
  }

  void write(const Destination& destination)
  {
    writeBytes(m_Data.bytes(), destination(m_Heavy.string()));
    writeBytes(m_Text + "</Grid>\n</Domain>\n</Xdmf>\n", destination(m_Xdmf.string()));
  }

private:
  template <class Value>
  std::string item(const std::string& name, const Value* values, std::size_t rows, int columns)
  {
    m_Data.add(name, values, rows, columns);
    const bool real = std::is_same_v<Value, double>;
    return std::string("<DataItem NumberType=\"") + (real ? "Float" : "Int") + "\" Precision=\"" + (real ? "8" : "4") +
           "\" Format=\"HDF\" Dimensions=\"" + std::to_string(rows) +
           (columns > 1 ? " " + std::to_string(columns) : "") + "\">" + escaped(m_Heavy.filename().string()) + ":/" +
           name + "</DataItem>";
  }

  std::filesystem::path m_Xdmf, m_Heavy;
  std::string m_Text;
  MemoryFile m_Data;
};

void writeElements(const FiniteElementModel& model, const std::string& file, const Destination& destination)
{
  const MeshFile& content = model.content;
  XdmfFile xdmf(file, "mesh");
  xdmf.topology(model.elements, 3);
  xdmf.geometry(content.mesh.points);
  const std::vector<std::int32_t> labels(content.mesh.labels.begin(), content.mesh.labels.end());
  xdmf.attribute("TissueLabel", "Cell", labels);
  xdmf.attribute("SubMesh", "Cell", content.subMesh);
  xdmf.attribute("Constitutive", "Cell", content.constitutive);
  if (!content.targetEdgeLength.empty()) xdmf.attribute("TargetEdgeLength", "Node", content.targetEdgeLength);
  xdmf.write(destination);
}

void writeFacets(const FiniteElementModel& model, const std::string& file, const Destination& destination)
{
  std::vector<Cell> faces;
  std::vector<std::int32_t> tags;
  for (const FacePiece& piece : tagsOf(model).facePieces)
  {
    faces.insert(faces.end(), piece.cells.begin(), piece.cells.end());
    tags.resize(faces.size(), piece.tag);
  }
  XdmfFile xdmf(file, "facets");
  xdmf.topology(faces, 2);
  xdmf.geometry(model.content.mesh.points);
  xdmf.attribute("FacetTag", "Cell", tags);
  xdmf.write(destination);
}

void writeLines(const FiniteElementModel& model, const std::string& file, const Destination& destination)
{
  std::vector<Cell> edges;
  std::vector<std::int32_t> tags;
  std::vector<double> radii;
  const SetTags all = tagsOf(model);
  for (std::size_t b = 0; b < model.beams.size(); ++b)
  {
    const Beam& beam = model.beams[b];
    edges.insert(edges.end(), beam.edges.begin(), beam.edges.end());
    tags.resize(edges.size(), all.beams[b]);
    radii.resize(edges.size(), beam.radius);
  }
  XdmfFile xdmf(file, "curves");
  xdmf.topology(edges, 1);
  xdmf.geometry(model.content.mesh.points);
  xdmf.attribute("CurveTag", "Cell", tags);
  xdmf.attribute("Radius", "Cell", radii);
  xdmf.write(destination);
}

} // namespace

void writeXdmf(const FiniteElementModel& model, const std::string& file, const Destination& destination)
{
  const std::filesystem::path path(file);
  const auto beside = [&](const char* suffix)
  { return (path.parent_path() / (path.stem().string() + suffix + path.extension().string())).string(); };
  writeElements(model, file, destination);
  writeFacets(model, beside("_facets"), destination);
  if (!model.beams.empty()) writeLines(model, beside("_curves"), destination);
}

} // namespace surgicalmesher
