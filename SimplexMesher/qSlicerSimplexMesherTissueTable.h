// SPDX-License-Identifier: Apache-2.0
#pragma once
/// The tissues of a map, and what is asked of each: a filter, a table, and buttons for the selected rows. What the user
/// enters goes to the parameter node, and what the node says is shown.

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
    RoleColumn, ///< edited as text: the name of a role in the user's language, or that of a group
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

  /// Its model is filtered and sorted; an edit of a cell in a selected row is one of all selected rows.
  QTableView* view() const;

public slots:
  /// For the selected rows.
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
