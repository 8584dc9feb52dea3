// SPDX-License-Identifier: Apache-2.0
#pragma once
/// The tissues of a map and their settings: a filter, a table, and buttons for the selected rows. User input is written
/// to the parameter node, and changes of the node are shown.

#include "TissueRows.h"
#include "qSlicerSimplexMesherModuleExport.h"

#include <ctkVTKObject.h>

#include <QScopedPointer>
#include <QWidget>

#include <vector>

class QTableView;
class qSlicerSimplexMesherTissueTablePrivate;
class vtkMRMLSimplexMesherNode;

class Q_SLICER_QTMODULES_SIMPLEXMESHER_EXPORT qSlicerSimplexMesherTissueTable : public QWidget
{
  Q_OBJECT
  QVTK_OBJECT

public:
  enum Column
  {
    NameColumn,
    LabelColumn,
    VolumeColumn,
    RoleColumn, ///< edited as text: the name of a role in the user's language, or of a group
    MinimumColumn,
    MaximumColumn,
    ProtectedColumn, ///< a check box
    IslandsColumn,
    CavitiesColumn,
    ColumnCount
  };

  explicit qSlicerSimplexMesherTissueTable(QWidget* parent = nullptr);
  ~qSlicerSimplexMesherTissueTable() override;

  /// Null empties the table.
  void setParameterNode(vtkMRMLSimplexMesherNode* node);
  void setTissues(const std::vector<surgicalmesher::TissueRow>& tissues);
  const std::vector<surgicalmesher::TissueRow>& tissues() const;

  /// The view has a filtered and sorted model; editing a cell in a selected row edits all selected rows.
  QTableView* view() const;

public slots:
  /// These apply to the selected rows.
  void meshSelected();
  void makeSelectedShells();
  void leaveOutSelected();
  void groupSelected(const QString& name);
  void resetSelected();

private slots:
  void onNodeModified();
  void askForGroup();

private:
  Q_DECLARE_PRIVATE(qSlicerSimplexMesherTissueTable)
  Q_DISABLE_COPY(qSlicerSimplexMesherTissueTable)
  QScopedPointer<qSlicerSimplexMesherTissueTablePrivate> d_ptr;
};
