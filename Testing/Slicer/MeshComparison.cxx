// SPDX-License-Identifier: Apache-2.0
#include "MeshComparison.h"

#include <vtkMRMLModelNode.h>

#include <vtkCell.h>
#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkFieldData.h>
#include <vtkIdList.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPointSet.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkSmartPointer.h>
#include <vtkStringArray.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLPolyDataReader.h>
#include <vtkXMLUnstructuredGridReader.h>

#include <QDir>
#include <QFile>
#include <QProcess>

#include <algorithm>
#include <array>
#include <set>
#include <stdexcept>

namespace surgicalmesher::test
{
namespace
{

std::string number(vtkIdType n) { return std::to_string(n); }

std::string pointDifference(vtkPointSet* a, vtkPointSet* b)
{
  if (a->GetNumberOfPoints() != b->GetNumberOfPoints())
  {
    return number(a->GetNumberOfPoints()) + " points against " + number(b->GetNumberOfPoints());
  }
  for (vtkIdType i = 0; i < a->GetNumberOfPoints(); ++i)
  {
    std::array<double, 3> p, q;
    a->GetPoint(i, p.data());
    b->GetPoint(i, q.data());
    if (p != q) return "point " + number(i) + " elsewhere";
  }
  return {};
}

std::string cellDifference(vtkPointSet* a, vtkPointSet* b)
{
  if (a->GetNumberOfCells() != b->GetNumberOfCells())
  {
    return number(a->GetNumberOfCells()) + " cells against " + number(b->GetNumberOfCells());
  }
  vtkNew<vtkIdList> p, q;
  for (vtkIdType i = 0; i < a->GetNumberOfCells(); ++i)
  {
    a->GetCellPoints(i, p);
    b->GetCellPoints(i, q);
    const bool samePoints = p->GetNumberOfIds() == q->GetNumberOfIds() &&
                            std::equal(p->GetPointer(0), p->GetPointer(0) + p->GetNumberOfIds(), q->GetPointer(0));
    if (!samePoints || a->GetCellType(i) != b->GetCellType(i)) return "cell " + number(i) + " another";
  }
  return {};
}

bool sameShape(vtkAbstractArray* a, vtkAbstractArray* b)
{
  return a->GetDataType() == b->GetDataType() && a->GetNumberOfComponents() == b->GetNumberOfComponents() &&
         a->GetNumberOfTuples() == b->GetNumberOfTuples();
}

bool sameValues(vtkAbstractArray* a, vtkAbstractArray* b)
{
  for (vtkIdType i = 0; i < a->GetNumberOfValues(); ++i)
  {
    if (a->GetVariantValue(i) != b->GetVariantValue(i)) return false;
  }
  return true;
}

/// SPACE tells the frame of a file and is dropped by the host once it is read.
std::set<std::string> arrayNames(vtkFieldData* fields)
{
  std::set<std::string> names;
  for (int i = 0; i < fields->GetNumberOfArrays(); ++i)
  {
    const char* name = fields->GetAbstractArray(i)->GetName();
    names.insert(name ? name : "");
  }
  names.erase("SPACE");
  return names;
}

std::string arrayDifference(const std::string& place, vtkFieldData* a, vtkFieldData* b)
{
  const std::set<std::string> namesA = arrayNames(a), namesB = arrayNames(b);
  std::set<std::string> names = namesA;
  names.insert(namesB.begin(), namesB.end());
  for (const std::string& name : names)
  {
    if (!namesA.count(name) || !namesB.count(name)) return place + " array " + name + " in one only";
    vtkAbstractArray* arrayA = a->GetAbstractArray(name.c_str());
    vtkAbstractArray* arrayB = b->GetAbstractArray(name.c_str());
    if (!sameShape(arrayA, arrayB) || !sameValues(arrayA, arrayB)) return place + " array " + name + " another";
  }
  return {};
}

bool endsWith(const std::string& text, const std::string& end)
{
  return text.size() >= end.size() && text.compare(text.size() - end.size(), end.size(), end) == 0;
}

template <typename Reader>
vtkSmartPointer<vtkPointSet> readBy(const std::string& file)
{
  vtkNew<Reader> reader;
  reader->SetFileName(file.c_str());
  reader->Update();
  return reader->GetOutput();
}

vtkSmartPointer<vtkPointSet> readMesh(const std::string& file)
{
  if (endsWith(file, ".vtp")) return readBy<vtkXMLPolyDataReader>(file);
  if (endsWith(file, ".vtu")) return readBy<vtkXMLUnstructuredGridReader>(file);
  throw std::runtime_error(file + ": .vtp or .vtu expected");
}

/// From LPS to RAS.
void turnOver(vtkPointSet* mesh)
{
  vtkPoints* points = mesh->GetPoints();
  for (vtkIdType i = 0; i < mesh->GetNumberOfPoints(); ++i)
  {
    std::array<double, 3> p;
    points->GetPoint(i, p.data());
    points->SetPoint(i, -p[0], -p[1], p[2]);
  }
}

} // namespace

std::string differenceOf(vtkPointSet* a, vtkPointSet* b)
{
  if (!a || !b) return "no mesh";
  if (!a->IsA(b->GetClassName())) return std::string(a->GetClassName()) + " against " + b->GetClassName();
  for (const std::string& difference :
       { pointDifference(a, b), cellDifference(a, b), arrayDifference("point", a->GetPointData(), b->GetPointData()),
         arrayDifference("cell", a->GetCellData(), b->GetCellData()),
         arrayDifference("field", a->GetFieldData(), b->GetFieldData()) })
  {
    if (!difference.empty()) return difference;
  }
  return {};
}

std::string differenceOf(const std::string& file, vtkMRMLModelNode* model)
{
  const vtkSmartPointer<vtkPointSet> mesh = readMesh(file);
  turnOver(mesh);
  return differenceOf(mesh, model ? model->GetMesh() : nullptr);
}

bool sameBytes(const std::string& fileA, const std::string& fileB)
{
  QFile a(QString::fromStdString(fileA)), b(QString::fromStdString(fileB));
  return a.open(QIODevice::ReadOnly) && b.open(QIODevice::ReadOnly) && a.readAll() == b.readAll();
}

void runCommandLine(const std::string& executable, const std::vector<std::string>& arguments)
{
  QStringList words;
  for (const std::string& argument : arguments) words << QString::fromStdString(argument);
  QProcess process;
  process.start(SURGICALMESHER_CLI_MODULES "/" + QString::fromStdString(executable), words);
  const bool ended = process.waitForFinished(-1);
  if (!ended || process.exitStatus() != QProcess::NormalExit || process.exitCode() != 0)
  {
    throw std::runtime_error(executable + ": " + process.readAllStandardError().toStdString());
  }
}

std::string newFolder(const std::string& testName)
{
  QDir folder(SURGICALMESHER_TEST_FOLDER "/" + QString::fromStdString(testName));
  folder.removeRecursively();
  folder.mkpath(".");
  return folder.path().toStdString();
}

} // namespace surgicalmesher::test
