// SPDX-License-Identifier: Apache-2.0
#include "ExodusExport.h"

#include "Errors.h"
#include "Portions.h"
#include "Units.h"

#include <vtk_exodusII.h>

#include <cstring>
#include <map>
#include <numeric>
#include <utility>

namespace surgicalmesher
{
namespace
{

using Ids = std::vector<int>;

/// Cells of one shape, numbered from 1: solids in the order of the mesh, then shells, then curves.
struct Block
{
  std::string name, type;
  std::vector<Cell> cells;
  Ids numbers;
  std::string attribute; ///< name of `value`; empty if there is none
  double value = 0;
};

const std::map<std::string, std::string> kSolids{
  { "tet4", "TETRA" }, { "penta6", "WEDGE" }, { "hex8", "HEX8" }, { "tet10", "TETRA10" }
};
const std::map<std::string, std::string> kFaces{ { "tri3", "TRI3" }, { "quad4", "SHELL4" }, { "tri6", "TRI6" } };

/// Returns the side number of Exodus for a face of a tetrahedron, wedge or hexahedron.
int sideOf(const Cell& element, int face)
{
  constexpr int kTetrahedron[4] = { 2, 3, 1, 4 }, kWedge[5] = { 4, 5, 1, 2, 3 }, kHexahedron[6] = { 5, 6, 1, 2, 3, 4 };
  return element.size() == 6 ? kWedge[face] : element.size() == 8 ? kHexahedron[face] : kTetrahedron[face];
}

std::vector<Block> blocksOf(const FiniteElementModel& model)
{
  std::vector<Block> blocks;
  for (const Section& section : model.sections)
  {
    for (const Portion& portion : portionsOf(model, model.elementSets[section.elementSet]))
    {
      Block block{ portion.name, kSolids.at(portion.shape), {}, {}, {} };
      for (const std::int32_t e : portion.elements)
      {
        block.cells.push_back(model.elements[e]);
        block.numbers.push_back(e + 1);
      }
      blocks.push_back(std::move(block));
    }
  }
  int next = static_cast<int>(model.elements.size());
  for (const Shell& shell : model.shells)
  {
    for (const Portion& portion : portionsOf(shell))
    {
      Block block{ portion.name, kFaces.at(portion.shape), {}, {}, "thickness", shell.thickness };
      for (const std::int32_t i : portion.elements)
      {
        block.cells.push_back(shell.cells[i]);
        block.numbers.push_back(next + i + 1);
      }
      blocks.push_back(std::move(block));
    }
    next += static_cast<int>(shell.cells.size());
  }
  for (const Beam& beam : model.beams)
  {
    Block block{
      beam.name, beam.isTruss ? "BAR2" : "BEAM2", beam.edges, Ids(beam.edges.size()), "radius", beam.radius
    };
    std::iota(block.numbers.begin(), block.numbers.end(), next + 1);
    next += static_cast<int>(beam.edges.size());
    blocks.push_back(std::move(block));
  }
  return blocks;
}

/// Names in the form that the library requires.
class Names
{
public:
  template <class Items>
  explicit Names(const Items& items)
  {
    for (const auto& item : items) m_Texts.push_back(item.name);
    for (std::string& text : m_Texts) m_Pointers.push_back(text.data());
  }
  char** data() { return m_Pointers.data(); }

private:
  std::vector<std::string> m_Texts;
  std::vector<char*> m_Pointers;
};

/// An Exodus file being written.
class ExodusFile
{
public:
  ExodusFile(const std::string& file, const std::string& place) : m_File(file)
  {
    ex_opts(EX_DEFAULT); // failures are reported by return values only
    int wordInMemory = sizeof(double), wordInFile = sizeof(double);
    m_Id = ex_create(place.c_str(), EX_CLOBBER | EX_LARGE_MODEL, &wordInMemory, &wordInFile);
    require(m_Id);
    require(ex_set_max_name_length(m_Id, kLongest));
  }
  ~ExodusFile()
  {
    if (m_Id >= 0) ex_close(m_Id);
  }
  ExodusFile(const ExodusFile&) = delete;
  ExodusFile& operator=(const ExodusFile&) = delete;

  void begin(const FiniteElementModel& model, const std::vector<Block>& blocks)
  {
    ex_init_params sizes{};
    std::strncpy(sizes.title, "SurgicalMesher", MAX_LINE_LENGTH);
    sizes.num_dim = 3;
    sizes.num_nodes = static_cast<std::int64_t>(model.content.mesh.points.size());
    for (const Block& block : blocks) sizes.num_elem += static_cast<std::int64_t>(block.cells.size());
    sizes.num_elem_blk = static_cast<std::int64_t>(blocks.size());
    sizes.num_elem_sets = static_cast<std::int64_t>(model.elementSets.size());
    sizes.num_node_sets = static_cast<std::int64_t>(model.nodeSets.size());
    sizes.num_side_sets = static_cast<std::int64_t>(model.surfaces.size());
    require(ex_put_init_ext(m_Id, &sizes));
    std::string units = frameAndUnits(model);
    char* lines[] = { units.data() };
    require(ex_put_info(m_Id, 1, lines));
  }

  void addPoints(const std::vector<Vec3>& points)
  {
    std::vector<double> along[3];
    for (const Vec3& p : points)
      for (int axis = 0; axis < 3; ++axis) along[axis].push_back(p[axis]);
    require(ex_put_coord(m_Id, along[0].data(), along[1].data(), along[2].data()));
  }

  void add(const Block& block, ex_entity_id number)
  {
    const std::size_t nodes = block.cells.front().size();
    require(ex_put_block(m_Id, EX_ELEM_BLOCK, number, block.type.c_str(), static_cast<std::int64_t>(block.cells.size()),
                         static_cast<std::int64_t>(nodes), 0, 0, block.attribute.empty() ? 0 : 1));
    Ids ids;
    for (const Cell& cell : block.cells)
      for (const std::int32_t id : cell) ids.push_back(id + 1);
    require(ex_put_conn(m_Id, EX_ELEM_BLOCK, number, ids.data(), nullptr, nullptr));
    if (block.attribute.empty()) return;
    const std::vector<double> values(block.cells.size(), block.value);
    require(ex_put_attr(m_Id, EX_ELEM_BLOCK, number, values.data()));
    std::string name = block.attribute;
    char* names[] = { name.data() };
    require(ex_put_attr_names(m_Id, EX_ELEM_BLOCK, number, names));
  }

  void addNumbers(const Ids& numbers) { require(ex_put_id_map(m_Id, EX_ELEM_MAP, numbers.data())); }

  void addSet(ex_entity_type type, ex_entity_id number, const Ids& entries, const Ids& sides = {})
  {
    require(ex_put_set_param(m_Id, type, number, static_cast<std::int64_t>(entries.size()), 0));
    require(ex_put_set(m_Id, type, number, entries.data(), sides.empty() ? nullptr : sides.data()));
  }

  template <class Items>
  void addNames(ex_entity_type type, const Items& items)
  {
    if (!items.empty()) require(ex_put_names(m_Id, type, Names(items).data()));
  }

  void end() { require(ex_close(std::exchange(m_Id, -1))); }

private:
  static constexpr int kLongest = 100; ///< for the name of a set plus that of a shape

  void require(int status) const
  {
    if (status < 0) throw InputError(m_File + ": can't be written");
  }

  std::string m_File;
  int m_Id = -1;
};

void addSets(ExodusFile& file, const FiniteElementModel& model, const Ids& place)
{
  const auto counted = [](const std::vector<std::int32_t>& ids)
  {
    Ids result;
    for (const std::int32_t id : ids) result.push_back(id + 1);
    return result;
  };
  for (std::size_t s = 0; s < model.nodeSets.size(); ++s)
    file.addSet(EX_NODE_SET, ex_entity_id(s + 1), counted(model.nodeSets[s].points));
  file.addNames(EX_NODE_SET, model.nodeSets);
  for (std::size_t s = 0; s < model.elementSets.size(); ++s)
  {
    Ids places;
    for (const std::int32_t e : model.elementSets[s].elements) places.push_back(place[e]);
    file.addSet(EX_ELEM_SET, ex_entity_id(s + 1), places);
  }
  file.addNames(EX_ELEM_SET, model.elementSets);
  for (std::size_t s = 0; s < model.surfaces.size(); ++s)
  {
    Ids places, sides;
    for (const auto& [element, face] : model.surfaces[s].faces)
    {
      places.push_back(place[element]);
      sides.push_back(sideOf(model.elements[element], face));
    }
    file.addSet(EX_SIDE_SET, ex_entity_id(s + 1), places, sides);
  }
  file.addNames(EX_SIDE_SET, model.surfaces);
}

} // namespace

void writeExodus(const FiniteElementModel& model, const std::string& file, const Destination& destination)
{
  const std::vector<Block> blocks = blocksOf(model);
  Ids numbers;
  for (const Block& block : blocks) numbers.insert(numbers.end(), block.numbers.begin(), block.numbers.end());
  Ids place(numbers.size()); // position of each element in the file, from 1
  for (std::size_t i = 0; i < numbers.size(); ++i) place[numbers[i] - 1] = static_cast<int>(i + 1);

  ExodusFile exodus(file, destination(file));
  exodus.begin(model, blocks);
  exodus.addPoints(model.content.mesh.points);
  for (std::size_t b = 0; b < blocks.size(); ++b) exodus.add(blocks[b], ex_entity_id(b + 1));
  exodus.addNames(EX_ELEM_BLOCK, blocks);
  exodus.addNumbers(numbers);
  addSets(exodus, model, place);
  exodus.end();
}

} // namespace surgicalmesher
