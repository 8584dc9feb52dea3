// SPDX-License-Identifier: Apache-2.0
#include "qSlicerSimplexMesherTissueTable.h"

#include "vtkMRMLSimplexMesherNode.h"

#include <QAbstractTableModel>
#include <QAction>
#include <QComboBox>
#include <QCoreApplication>
#include <QDoubleSpinBox>
#include <QHBoxLayout>
#include <QHeaderView>
#include <QInputDialog>
#include <QLineEdit>
#include <QMenu>
#include <QPushButton>
#include <QSortFilterProxyModel>
#include <QStyledItemDelegate>
#include <QTableView>
#include <QVBoxLayout>

#include <vtkWeakPointer.h>

#include <functional>
#include <set>

using surgicalmesher::TissueRole;
using surgicalmesher::TissueRow;
using surgicalmesher::TissueSetting;
using Table = qSlicerSimplexMesherTissueTable;

namespace
{

constexpr int SortRole = Qt::UserRole; // sorts numbers by value

QString roleName(TissueRole role)
{
  switch (role)
  {
  case TissueRole::Shell: return qSlicerSimplexMesherTissueTable::tr("Shell");
  case TissueRole::Leave: return qSlicerSimplexMesherTissueTable::tr("Leave out");
  default: return qSlicerSimplexMesherTissueTable::tr("Mesh");
  }
}

QString roleText(const TissueSetting& setting)
{
  return setting.role == TissueRole::Group ? QString::fromStdString(setting.group) : roleName(setting.role);
}

void setRole(TissueSetting& setting, TissueRole role, const QString& group = QString())
{
  setting.role = role;
  setting.group = group.simplified().toStdString();
}

void setRoleText(TissueSetting& setting, const QString& text)
{
  for (const TissueRole role : { TissueRole::Mesh, TissueRole::Shell, TissueRole::Leave })
  {
    if (text.compare(roleName(role), Qt::CaseInsensitive) == 0) return setRole(setting, role);
  }
  if (!text.simplified().isEmpty()) setRole(setting, TissueRole::Group, text);
}

/// Returns a reference to the value of a numeric column.
double& numberAt(TissueSetting& setting, int column)
{
  if (column == Table::MinimumColumn) return setting.minimumEdgeLength;
  if (column == Table::MaximumColumn) return setting.maximumEdgeLength;
  return column == Table::IslandsColumn ? setting.islandVolume : setting.cavityVolume;
}

bool isLength(int column) { return column == Table::MinimumColumn || column == Table::MaximumColumn; }

bool isNumber(int column)
{
  return isLength(column) || column == Table::IslandsColumn || column == Table::CavitiesColumn;
}

double openValue(int column) { return isLength(column) ? 0 : -1; }

QString volumeText(double volume)
{
  if (volume < 0) return qSlicerSimplexMesherTissueTable::tr("unknown");
  return volume < 1000 ? qSlicerSimplexMesherTissueTable::tr("%L1 mm³").arg(volume, 0, 'f', 0)
                       : qSlicerSimplexMesherTissueTable::tr("%L1 ml").arg(volume / 1000, 0, 'f', 1);
}

QString tooltip(const TissueRow& tissue)
{
  const QString text = qSlicerSimplexMesherTissueTable::tr("%1: label %2")
                         .arg(QString::fromStdString(tissue.name).toHtmlEscaped())
                         .arg(tissue.label);
  return tissue.voxels < 0
           ? text
           : qSlicerSimplexMesherTissueTable::tr("%1, %L2 voxels").arg(text).arg(qlonglong(tissue.voxels));
}

struct ColumnText
{
  QString title, tip;
};

ColumnText columnText(int column)
{
  switch (column)
  {
  case Table::NameColumn:
    return { qSlicerSimplexMesherTissueTable::tr("Tissue"),
             qSlicerSimplexMesherTissueTable::tr("Name and colour of the tissue") };
  case Table::LabelColumn:
    return { qSlicerSimplexMesherTissueTable::tr("Label"),
             qSlicerSimplexMesherTissueTable::tr("Value of the tissue's voxels") };
  case Table::VolumeColumn:
    return { qSlicerSimplexMesherTissueTable::tr("Volume"),
             qSlicerSimplexMesherTissueTable::tr("Volume of the tissue's voxels") };
  case Table::RoleColumn:
    return { qSlicerSimplexMesherTissueTable::tr("Role"),
             qSlicerSimplexMesherTissueTable::tr(
               "Mesh: a tissue of its own. Shell: a surface of one edge length, such as a vessel or the dura. "
               "Leave out: background. Any other text names a group, whose members become one tissue") };
  case Table::MinimumColumn:
    return { qSlicerSimplexMesherTissueTable::tr("Min."),
             qSlicerSimplexMesherTissueTable::tr(
               "Smallest edge length within the tissue and on its surface (mm); empty: no limit") };
  case Table::MaximumColumn:
    return { qSlicerSimplexMesherTissueTable::tr("Max."),
             qSlicerSimplexMesherTissueTable::tr(
               "Largest edge length within the tissue and on its surface (mm); empty: no limit") };
  case Table::ProtectedColumn:
    return { qSlicerSimplexMesherTissueTable::tr("Protect"),
             qSlicerSimplexMesherTissueTable::tr("Spare the tissue from simplification by the feature scale") };
  case Table::IslandsColumn:
    return { qSlicerSimplexMesherTissueTable::tr("Islands"),
             qSlicerSimplexMesherTissueTable::tr(
               "Pieces of the tissue below this volume (mm³) are removed; empty: as for all tissues") };
  default:
    return { qSlicerSimplexMesherTissueTable::tr("Cavities"),
             qSlicerSimplexMesherTissueTable::tr(
               "Background enclosed by the tissue, below this volume (mm³), is filled; empty: as for all tissues") };
  }
}

class TissueModel : public QAbstractTableModel
{
public:
  using QAbstractTableModel::QAbstractTableModel;

  vtkWeakPointer<vtkMRMLSimplexMesherNode> Node;
  std::vector<TissueRow> Tissues;

  void reset(const std::function<void()>& change)
  {
    this->beginResetModel();
    change();
    this->endResetModel();
  }

  void showChanges()
  {
    if (!this->Tissues.empty())
      emit this->dataChanged(this->index(0, 0), this->index(this->rowCount() - 1, Table::ColumnCount - 1));
  }

  int rowCount(const QModelIndex& parent = {}) const override
  {
    return parent.isValid() ? 0 : int(this->Tissues.size());
  }
  int columnCount(const QModelIndex& = {}) const override { return Table::ColumnCount; }

  TissueSetting setting(int row) const
  {
    return this->Node ? this->Node->GetTissueSetting(this->Tissues[row].id) : TissueSetting();
  }

  /// Changes the settings of all rows in a single modification of the node.
  void change(const std::set<int>& rows, const std::function<void(TissueSetting&)>& change)
  {
    if (!this->Node) return;
    vtkMRMLSimplexMesherNode::Settings settings = this->Node->GetTissueSettings();
    for (const int row : rows) change(settings[this->Tissues[row].id]);
    this->Node->SetTissueSettings(settings);
  }

  Qt::ItemFlags flags(const QModelIndex& index) const override
  {
    const Qt::ItemFlags flags = Qt::ItemIsEnabled | Qt::ItemIsSelectable;
    if (index.column() == Table::ProtectedColumn) return flags | Qt::ItemIsUserCheckable | Qt::ItemIsEditable;
    return index.column() == Table::RoleColumn || isNumber(index.column()) ? flags | Qt::ItemIsEditable : flags;
  }

  QVariant data(const QModelIndex& index, int role) const override;
  QVariant headerData(int section, Qt::Orientation orientation, int role) const override;

private:
  QString text(const TissueRow& tissue, TissueSetting setting, int column) const;
  QVariant sortKey(const TissueRow& tissue, TissueSetting setting, int column) const;
};

QString TissueModel::text(const TissueRow& tissue, TissueSetting setting, int column) const
{
  switch (column)
  {
  case Table::NameColumn: return QString::fromStdString(tissue.name);
  case Table::LabelColumn: return QString::number(tissue.label);
  case Table::VolumeColumn: return volumeText(tissue.volume);
  case Table::RoleColumn: return roleText(setting);
  case Table::ProtectedColumn: return QString();
  default:
  {
    const double value = numberAt(setting, column);
    return value == openValue(column) ? QString() : QString("%L1").arg(value);
  }
  }
}

QVariant TissueModel::sortKey(const TissueRow& tissue, TissueSetting setting, int column) const
{
  if (column == Table::LabelColumn) return int(tissue.label);
  if (column == Table::VolumeColumn) return tissue.volume;
  if (column == Table::ProtectedColumn) return setting.isProtected;
  return isNumber(column) ? QVariant(numberAt(setting, column)) : QVariant(this->text(tissue, setting, column));
}

QVariant TissueModel::data(const QModelIndex& index, int role) const
{
  const TissueRow& tissue = this->Tissues[index.row()];
  const int column = index.column();
  TissueSetting setting = this->setting(index.row());
  switch (role)
  {
  case Qt::DisplayRole: return this->text(tissue, setting, column);
  case SortRole: return this->sortKey(tissue, setting, column);
  case Qt::EditRole:
    return isNumber(column) ? QVariant(numberAt(setting, column)) : QVariant(this->text(tissue, setting, column));
  case Qt::DecorationRole:
    if (column != Table::NameColumn) return {};
    return QColor::fromRgbF(tissue.color[0], tissue.color[1], tissue.color[2]);
  case Qt::CheckStateRole:
    if (column != Table::ProtectedColumn) return {};
    return int(setting.isProtected ? Qt::Checked : Qt::Unchecked);
  case Qt::TextAlignmentRole:
    return int(Qt::AlignVCenter |
               (column == Table::NameColumn || column == Table::RoleColumn ? Qt::AlignLeft : Qt::AlignRight));
  case Qt::ForegroundRole: return setting.role == TissueRole::Leave ? QVariant(QColor(Qt::gray)) : QVariant();
  case Qt::ToolTipRole:
    if (column != Table::NameColumn) return this->headerData(column, Qt::Horizontal, Qt::ToolTipRole);
    return tooltip(tissue);
  default: return {};
  }
}

QVariant TissueModel::headerData(int section, Qt::Orientation orientation, int role) const
{
  if (orientation != Qt::Horizontal) return {};
  const ColumnText text = columnText(section);
  return role == Qt::DisplayRole ? QVariant(text.title) : role == Qt::ToolTipRole ? QVariant(text.tip) : QVariant();
}

/// Filters by name, and applies an edit to all selected rows.
class TissueFilter : public QSortFilterProxyModel
{
public:
  TissueFilter(TissueModel* model, QTableView* view) : QSortFilterProxyModel(view), Model(model), View(view)
  {
    this->setSourceModel(model);
    this->setFilterCaseSensitivity(Qt::CaseInsensitive);
    this->setSortRole(SortRole);
    this->setSortCaseSensitivity(Qt::CaseInsensitive);
  }

  std::set<int> selectedRows() const
  {
    std::set<int> rows;
    for (const QModelIndex& index : this->View->selectionModel()->selectedRows())
      rows.insert(this->mapToSource(index).row());
    return rows;
  }

  bool setData(const QModelIndex& index, const QVariant& value, int role) override
  {
    if (role != Qt::EditRole && role != Qt::CheckStateRole) return false;
    std::set<int> rows{ this->mapToSource(index).row() };
    if (this->View->selectionModel()->isRowSelected(index.row(), QModelIndex())) rows = this->selectedRows();
    const int column = index.column();
    this->Model->change(rows,
                        [&](TissueSetting& setting)
                        {
                          if (column == Table::RoleColumn) setRoleText(setting, value.toString());
                          else if (column == Table::ProtectedColumn) setting.isProtected = value.toInt() == Qt::Checked;
                          else if (isNumber(column)) numberAt(setting, column) = value.toDouble();
                        });
    return true;
  }

private:
  TissueModel* Model;
  QTableView* View;
};

class TissueDelegate : public QStyledItemDelegate
{
public:
  TissueDelegate(const TissueModel* model, QObject* parent) : QStyledItemDelegate(parent), Model(model) {}

  QWidget* createEditor(QWidget* parent, const QStyleOptionViewItem&, const QModelIndex& index) const override
  {
    if (index.column() == Table::RoleColumn) return this->roleEditor(parent);
    return isNumber(index.column()) ? this->numberEditor(parent, index.column()) : nullptr;
  }

  void setEditorData(QWidget* editor, const QModelIndex& index) const override
  {
    if (auto* box = qobject_cast<QComboBox*>(editor)) box->setCurrentText(index.data(Qt::EditRole).toString());
    else if (auto* spin = qobject_cast<QDoubleSpinBox*>(editor)) spin->setValue(index.data(Qt::EditRole).toDouble());
  }

  void setModelData(QWidget* editor, QAbstractItemModel* model, const QModelIndex& index) const override
  {
    auto* spin = qobject_cast<QDoubleSpinBox*>(editor);
    if (spin) spin->interpretText();
    model->setData(index, spin ? QVariant(spin->value()) : QVariant(qobject_cast<QComboBox*>(editor)->currentText()));
  }

private:
  QWidget* roleEditor(QWidget* parent) const
  {
    auto* box = new QComboBox(parent);
    box->setEditable(true);
    box->setInsertPolicy(QComboBox::NoInsert);
    box->setMinimumWidth(box->fontMetrics().averageCharWidth() * 24); // cells may be narrower than the names of groups
    for (const TissueRole role : { TissueRole::Mesh, TissueRole::Shell, TissueRole::Leave })
      box->addItem(roleName(role));
    QSet<QString> groups;
    for (int row = 0; row < this->Model->rowCount(); ++row)
    {
      const TissueSetting setting = this->Model->setting(row);
      if (setting.role == TissueRole::Group) groups.insert(QString::fromStdString(setting.group));
    }
    QStringList names(groups.begin(), groups.end());
    names.sort();
    box->addItems(names);
    return box;
  }

  QWidget* numberEditor(QWidget* parent, int column) const
  {
    auto* spin = new QDoubleSpinBox(parent);
    spin->setDecimals(isLength(column) ? 2 : 0);
    spin->setSingleStep(isLength(column) ? 0.1 : 1);
    spin->setRange(openValue(column), isLength(column) ? 100 : 1e6);
    spin->setSpecialValueText(qSlicerSimplexMesherTissueTable::tr("none"));
    spin->setFrame(false);
    return spin;
  }

  const TissueModel* Model;
};

/// A click into an editable cell leaves the selection unchanged. The name column gets the width that the other columns
/// leave, with a legible minimum.
class TissueView : public QTableView
{
public:
  using QTableView::QTableView;

  void fitNames()
  {
    int others = 0;
    for (int column = Table::NameColumn + 1; column < Table::ColumnCount; ++column)
      others += this->isColumnHidden(column) ? 0 : this->columnWidth(column);
    const int legible = this->fontMetrics().averageCharWidth() * 20;
    this->setColumnWidth(Table::NameColumn, qMax(legible, this->viewport()->width() - others));
  }

protected:
  void resizeEvent(QResizeEvent* event) override
  {
    QTableView::resizeEvent(event);
    this->fitNames();
  }

  QItemSelectionModel::SelectionFlags selectionCommand(const QModelIndex& index, const QEvent* event) const override
  {
    const bool isRelease = event && event->type() == QEvent::MouseButtonRelease;
    if (isRelease && index.isValid() && (index.flags() & Qt::ItemIsEditable)) return QItemSelectionModel::NoUpdate;
    return QTableView::selectionCommand(index, event);
  }
};

} // namespace

class qSlicerSimplexMesherTissueTablePrivate
{
public:
  QLineEdit* Filter = nullptr;
  TissueView* View = nullptr;
  TissueModel* Model = nullptr;
  TissueFilter* Proxy = nullptr;
  QList<QPushButton*> Buttons;

  void makeView(QWidget* parent);
  void addColumnActions();
  QPushButton* addButton(QHBoxLayout* layout, const QString& name, const QString& text, const QString& tip);
  void enableButtons()
  {
    for (QPushButton* button : this->Buttons) button->setEnabled(this->View->selectionModel()->hasSelection());
  }
};

void qSlicerSimplexMesherTissueTablePrivate::makeView(QWidget* parent)
{
  this->View = new TissueView(parent);
  this->View->setObjectName("TissueView");
  this->View->setAccessibleName(qSlicerSimplexMesherTissueTable::tr("Tissues"));
  this->Model = new TissueModel(parent);
  this->Proxy = new TissueFilter(this->Model, this->View);
  this->View->setModel(this->Proxy);
  this->View->setItemDelegate(new TissueDelegate(this->Model, this->View));
  this->View->setSelectionBehavior(QAbstractItemView::SelectRows);
  this->View->setEditTriggers(QAbstractItemView::DoubleClicked | QAbstractItemView::SelectedClicked |
                              QAbstractItemView::EditKeyPressed | QAbstractItemView::AnyKeyPressed);
  this->View->setTabKeyNavigation(false); // Tab moves on through the panel
  this->View->setAlternatingRowColors(true);
  this->View->setShowGrid(false);
  this->View->setWordWrap(false);
  this->View->setSortingEnabled(true);
  this->View->sortByColumn(-1, Qt::AscendingOrder); // the order of the list
  this->View->verticalHeader()->hide();
  this->View->verticalHeader()->setDefaultSectionSize(this->View->fontMetrics().height() + 6);
  this->View->setMinimumHeight(160);
  QHeaderView* header = this->View->horizontalHeader();
  header->setSectionResizeMode(QHeaderView::ResizeToContents);
  header->setSectionResizeMode(Table::NameColumn, QHeaderView::Interactive);
  QObject::connect(header, &QHeaderView::sectionResized, this->View,
                   [view = this->View](int column)
                   {
                     if (column != Table::NameColumn) view->fitNames();
                   });
  header->setHighlightSections(false);
  this->View->hideColumn(Table::LabelColumn);
  this->View->hideColumn(Table::IslandsColumn);
  this->View->hideColumn(Table::CavitiesColumn);
  this->addColumnActions();
}

/// Adds a context menu to the header that selects the visible columns.
void qSlicerSimplexMesherTissueTablePrivate::addColumnActions()
{
  QHeaderView* header = this->View->horizontalHeader();
  header->setContextMenuPolicy(Qt::ActionsContextMenu);
  for (int column = Table::LabelColumn; column < Table::ColumnCount; ++column)
  {
    auto* action = new QAction(this->Model->headerData(column, Qt::Horizontal, Qt::DisplayRole).toString(), header);
    action->setCheckable(true);
    action->setChecked(!this->View->isColumnHidden(column));
    QObject::connect(action, &QAction::toggled, this->View,
                     [view = this->View, column](bool shown) { view->setColumnHidden(column, !shown); });
    header->addAction(action);
  }
}

QPushButton* qSlicerSimplexMesherTissueTablePrivate::addButton(QHBoxLayout* layout, const QString& name,
                                                               const QString& text, const QString& tip)
{
  auto* button = new QPushButton(text);
  button->setObjectName(name);
  button->setToolTip(tip);
  layout->addWidget(button);
  this->Buttons << button;
  return button;
}

qSlicerSimplexMesherTissueTable::qSlicerSimplexMesherTissueTable(QWidget* parent)
  : QWidget(parent), d_ptr(new qSlicerSimplexMesherTissueTablePrivate)
{
  Q_D(qSlicerSimplexMesherTissueTable);
  auto* layout = new QVBoxLayout(this);
  layout->setContentsMargins(0, 0, 0, 0);
  d->Filter = new QLineEdit(this);
  d->Filter->setObjectName("TissueFilter");
  d->Filter->setPlaceholderText(tr("Filter by name"));
  d->Filter->setAccessibleName(d->Filter->placeholderText());
  d->Filter->setToolTip(tr("Show the tissues whose names contain this text"));
  d->Filter->setClearButtonEnabled(true);
  layout->addWidget(d->Filter);
  d->makeView(this);
  layout->addWidget(d->View);
  auto* buttons = new QHBoxLayout;
  layout->addLayout(buttons);
  auto* mesh = d->addButton(buttons, "MeshButton", tr("Mesh"), tr("Mesh each selected tissue as one of its own"));
  auto* group = d->addButton(buttons, "GroupButton", tr("Group..."), tr("Mesh the selected tissues as one"));
  auto* shell =
    d->addButton(buttons, "ShellButton", tr("Shell"), tr("Mesh the selected tissues as surfaces of one edge length"));
  auto* leave = d->addButton(buttons, "LeaveOutButton", tr("Leave out"), tr("Make background of the selected tissues"));
  auto* reset = d->addButton(buttons, "ResetButton", tr("Reset"), tr("Forget what is asked of the selected tissues"));

  connect(d->Filter, &QLineEdit::textChanged, d->Proxy, &QSortFilterProxyModel::setFilterFixedString);
  connect(mesh, &QPushButton::clicked, this, &qSlicerSimplexMesherTissueTable::meshSelected);
  connect(group, &QPushButton::clicked, this, &qSlicerSimplexMesherTissueTable::askForGroup);
  connect(shell, &QPushButton::clicked, this, &qSlicerSimplexMesherTissueTable::makeSelectedShells);
  connect(leave, &QPushButton::clicked, this, &qSlicerSimplexMesherTissueTable::leaveOutSelected);
  connect(reset, &QPushButton::clicked, this, &qSlicerSimplexMesherTissueTable::resetSelected);
  connect(d->View->selectionModel(), &QItemSelectionModel::selectionChanged, this, [d] { d->enableButtons(); });
  connect(d->Proxy, &QAbstractItemModel::modelReset, this, [d] { d->enableButtons(); });
  d->enableButtons();
}

qSlicerSimplexMesherTissueTable::~qSlicerSimplexMesherTissueTable() = default;

void qSlicerSimplexMesherTissueTable::setParameterNode(vtkMRMLSimplexMesherNode* node)
{
  Q_D(qSlicerSimplexMesherTissueTable);
  if (node == d->Model->Node) return;
  this->qvtkReconnect(d->Model->Node, node, vtkCommand::ModifiedEvent, this, SLOT(onNodeModified()));
  d->Model->reset([&] { d->Model->Node = node; });
}

void qSlicerSimplexMesherTissueTable::setTissues(const std::vector<TissueRow>& tissues)
{
  Q_D(qSlicerSimplexMesherTissueTable);
  d->Model->reset([&] { d->Model->Tissues = tissues; });
}

const std::vector<TissueRow>& qSlicerSimplexMesherTissueTable::tissues() const { return d_ptr->Model->Tissues; }

QTableView* qSlicerSimplexMesherTissueTable::view() const { return d_ptr->View; }

void qSlicerSimplexMesherTissueTable::meshSelected()
{
  Q_D(qSlicerSimplexMesherTissueTable);
  d->Model->change(d->Proxy->selectedRows(), [](TissueSetting& setting) { setRole(setting, TissueRole::Mesh); });
}

void qSlicerSimplexMesherTissueTable::makeSelectedShells()
{
  Q_D(qSlicerSimplexMesherTissueTable);
  d->Model->change(d->Proxy->selectedRows(), [](TissueSetting& setting) { setRole(setting, TissueRole::Shell); });
}

void qSlicerSimplexMesherTissueTable::leaveOutSelected()
{
  Q_D(qSlicerSimplexMesherTissueTable);
  d->Model->change(d->Proxy->selectedRows(), [](TissueSetting& setting) { setRole(setting, TissueRole::Leave); });
}

void qSlicerSimplexMesherTissueTable::groupSelected(const QString& name)
{
  Q_D(qSlicerSimplexMesherTissueTable);
  if (name.simplified().isEmpty()) return;
  d->Model->change(d->Proxy->selectedRows(),
                   [&](TissueSetting& setting) { setRole(setting, TissueRole::Group, name); });
}

void qSlicerSimplexMesherTissueTable::resetSelected()
{
  Q_D(qSlicerSimplexMesherTissueTable);
  d->Model->change(d->Proxy->selectedRows(), [](TissueSetting& setting) { setting = TissueSetting(); });
}

void qSlicerSimplexMesherTissueTable::onNodeModified() { d_ptr->Model->showChanges(); }

void qSlicerSimplexMesherTissueTable::askForGroup()
{
  bool accepted = false;
  const QString name = QInputDialog::getText(this, tr("Group of tissues"), tr("Name of the group:"), QLineEdit::Normal,
                                             QString(), &accepted);
  if (accepted) this->groupSelected(name);
}
