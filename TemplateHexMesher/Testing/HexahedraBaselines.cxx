// SPDX-License-Identifier: Apache-2.0
// Hexahedra of a person by the methods that Kim et al. 2018 compare theirs with, on the same elements, and by this
// project's. usage: HexahedraBaselines SIDES FITTED_SIDES PERSON LANDMARKS PERSON_LANDMARKS COLUMNS,DEPTH,ROWS...
//
// SIDES is the template's envelope with its sides, FITTED_SIDES the same fitted to the person, PERSON the person's
// envelope, LANDMARKS the markups of both. Prints one line for each method and divisions.

#include "ElementMeshIO.h"
#include "ElementQuality.h"
#include "Errors.h"
#include "Landmarks.h"
#include "Text.h"
#include "ThinPlateSpline.h"
#include "TissueMapIO.h"
#include "VolumetricHexahedra.h"

#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkGenericCell.h>
#include <vtkNew.h>
#include <vtkPointSet.h>
#include <vtkStaticCellLocator.h>
#include <vtkUnstructuredGrid.h>

#include <cstdio>
#include <exception>

using namespace surgicalmesher;

namespace
{

constexpr double edgeLength = 3; // mm, of the tetrahedra, as VolumetricHexCLI has it

Envelope readEnvelope(const std::string& file)
{
  const ElementMeshFile content = readElementMesh(file);
  vtkDataArray* sides = content.data->GetCellData()->GetArray("Side");
  if (!sides) throw InputError(file + ": no cell array Side");
  Envelope envelope;
  envelope.surface.points = content.mesh.points;
  for (std::size_t e = 0; e < content.mesh.elements.size(); ++e)
  {
    const auto& nodes = content.mesh.elements[e].nodes;
    envelope.surface.triangles.push_back({ nodes[0], nodes[1], nodes[2] });
    envelope.sides.push_back(Side(int(sides->GetComponent(vtkIdType(e), 0))));
  }
  return envelope;
}

NamedPoints readLandmarks(const std::string& file)
{
  const Markup markup = readLabelledMarkups(file).front();
  NamedPoints result{ file, markup.labels, Points(3, Eigen::Index(markup.points.size())) };
  for (std::size_t i = 0; i < markup.points.size(); ++i)
    result.points.col(Eigen::Index(i)) = Eigen::Vector3d(markup.points[i].x, markup.points[i].y, markup.points[i].z);
  return result;
}

/// From three coordinates of the tetrahedra's points back to places.
class FieldMap
{
public:
  FieldMap(const Tetrahedra& mesh, const Points& coordinates) : m_Mesh(mesh)
  {
    vtkNew<vtkPoints> points;
    points->SetDataTypeToDouble();
    for (Eigen::Index i = 0; i < coordinates.cols(); ++i) points->InsertNextPoint(coordinates.col(i).data());
    m_Grid->SetPoints(points);
    for (const auto& cell : mesh.cells)
    {
      const vtkIdType ids[] = { cell[0], cell[1], cell[2], cell[3] };
      m_Grid->InsertNextCell(VTK_TETRA, 4, ids);
    }
    m_Locator->SetDataSet(m_Grid);
    m_Locator->BuildLocator();
  }

  Eigen::Vector3d at(const Eigen::Vector3d& coordinates)
  {
    double closest[3], distance = 0, inCell[3], weights[4];
    vtkIdType found = 0;
    int part = 0;
    m_Locator->FindClosestPoint(coordinates.data(), closest, m_Cell, found, part, distance);
    m_Grid->GetCell(found)->EvaluatePosition(closest, nullptr, part, inCell, distance, weights);
    Eigen::Vector3d place = Eigen::Vector3d::Zero();
    for (int i = 0; i < 4; ++i) place += weights[i] * m_Mesh.points.col(m_Mesh.cells[std::size_t(found)][i]);
    return place;
  }

private:
  const Tetrahedra& m_Mesh;
  vtkNew<vtkUnstructuredGrid> m_Grid;
  vtkNew<vtkStaticCellLocator> m_Locator;
  vtkNew<vtkGenericCell> m_Cell;
};

/// The divided cube by three harmonic fields of the person's envelope, none of them corrected.
Points byThreeFields(const Envelope& person, const LayeredMesh& layered)
{
  const FilledEnvelope filled = filledEnvelope(person, edgeLength, "person");
  Points coordinates(3, filled.mesh.points.cols());
  coordinates.row(0) = harmonicBetween(filled, Side::Right, Side::Left).transpose();
  coordinates.row(1) = harmonicBetween(filled, Side::Outer, Side::Inner).transpose();
  coordinates.row(2) = harmonicBetween(filled, Side::Bottom, Side::Top).transpose();
  FieldMap map(filled.mesh, coordinates);
  Points points(3, Eigen::Index(layered.nodes.size()));
  for (std::size_t n = 0; n < layered.nodes.size(); ++n)
  {
    Eigen::Vector3d at;
    for (int axis = 0; axis < 3; ++axis) at[axis] = double(layered.nodes[n][axis]) / layered.divisions[axis];
    points.col(Eigen::Index(n)) = map.at(at);
  }
  return points;
}

/// The paper's third step: a spline of a thousand nodes of the surface, evenly chosen.
ThinPlateSpline splineOfSurface(const Points& from, const Points& to)
{
  const std::vector<std::int32_t> chosen = farthestPoints(from, 1000);
  return { from(Eigen::all, chosen), to(Eigen::all, chosen) };
}

void print(const char* method, const std::string& divisions, const std::vector<Element>& elements, const Points& points)
{
  const ElementMesh mesh{ points, elements };
  const QualitySummary summary = summaryOf(mesh, elementQuality(mesh), ElementShape::Hexahedron);
  std::printf("| %s | %s | %zu | %zu | %.3f | %.3f | %.3f |\n", divisions.c_str(), method, summary.elements,
              summary.invalid, summary.minimum, summary.mean, summary.meanShapeSkew);
  std::fflush(stdout);
}

HexOptions optionsFor(const std::string& divisions)
{
  HexOptions options;
  if (std::sscanf(divisions.c_str(), "%d,%d,%d", &options.divisions[0], &options.divisions[1], &options.divisions[2]) !=
      3)
    throw UsageError(divisions + ": expected three numbers with commas between");
  return options;
}

void run(const std::vector<std::string>& arguments)
{
  const Envelope source = readEnvelope(arguments[0]), fitted = readEnvelope(arguments[1]);
  const Envelope person = withSides(readSurfaceOf(arguments[2]), fitted.surface, fitted.sides, arguments[1]);
  const LandmarkPairs pairs = pairedByName(readLandmarks(arguments[3]), readLandmarks(arguments[4]));
  const ThinPlateSpline ofLandmarks(pairs.source, pairs.target);
  const ThinPlateSpline ofSurface = splineOfSurface(source.surface.points, fitted.surface.points);
  const SlabParameterisation slabOfSource = parameterise(source, edgeLength, arguments[0]);
  const SlabParameterisation slabOfPerson = parameterise(person, edgeLength, arguments[2]);
  for (std::size_t n = 5; n < arguments.size(); ++n)
  {
    const HexOptions options = optionsFor(arguments[n]);
    const LayeredMesh own = layeredHexahedra(slabOfPerson, options);
    const ElementMesh made = layeredHexahedra(slabOfSource, options).mesh;
    print("three harmonic fields", arguments[n], own.mesh.elements, byThreeFields(person, own));
    print("template's, by spline of landmarks", arguments[n], made.elements, ofLandmarks(made.points));
    print("template's, by spline of the fit", arguments[n], made.elements, ofSurface(made.points));
    print("this", arguments[n], own.mesh.elements, own.mesh.points);
  }
}

} // namespace

int main(int argc, char** argv)
{
  const std::vector<std::string> arguments(argv + 1, argv + argc);
  try
  {
    if (arguments.size() < 6)
      throw UsageError("usage: HexahedraBaselines SIDES FITTED_SIDES PERSON LANDMARKS PERSON_LANDMARKS DIVISIONS...");
    run(arguments);
  }
  catch (const std::exception& error)
  {
    std::fprintf(stderr, "HexahedraBaselines: %s\n", error.what());
    return 1;
  }
  return 0;
}
