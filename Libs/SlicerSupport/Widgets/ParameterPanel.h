// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Binds the controls of a panel to the values of its parameter node: user input is written to the node, and changes of
/// the node are shown. The private part of a module's widget derives from this class:
///
///     this->bind(this->EdgeLengthSlider, &Node::GetEdgeLength, &Node::SetEdgeLength);
///     this->bind(this->SurfaceSelector, Node::SurfaceRole());
///
/// bind() is called once for each control, after setupUi(); show() is called whenever the node has been modified.

#include "SceneNodes.h"

#include <ctkPathLineEdit.h>
#include <ctkSliderWidget.h>
#include <qMRMLCheckableNodeComboBox.h>
#include <qMRMLNodeComboBox.h>
#include <qMRMLNodeFactory.h>

#include <vtkWeakPointer.h>

#include <QAbstractButton>
#include <QComboBox>
#include <QDoubleSpinBox>
#include <QLineEdit>
#include <QScopedValueRollback>
#include <QSpinBox>

#include <algorithm>
#include <functional>
#include <string>
#include <vector>

namespace surgicalmesher
{

/// `Node` must derive from vtkMRMLSurgicalMesherParameterNode.
template <class Node>
class ParameterPanel
{
public:
  vtkWeakPointer<Node> Parameters; ///< null while no node is shown

  template <class Get, class Set>
  void bind(ctkSliderWidget* slider, Get get, Set set)
  {
    this->bindValue(slider, &ctkSliderWidget::valueChanged, get, set, &ctkSliderWidget::setValue);
  }
  template <class Get, class Set>
  void bind(QDoubleSpinBox* box, Get get, Set set)
  {
    this->bindValue(box, QOverload<double>::of(&QDoubleSpinBox::valueChanged), get, set, &QDoubleSpinBox::setValue);
  }
  template <class Get, class Set>
  void bind(QSpinBox* box, Get get, Set set)
  {
    this->bindValue(box, QOverload<int>::of(&QSpinBox::valueChanged), get, set, &QSpinBox::setValue);
  }
  template <class Get, class Set>
  void bind(QAbstractButton* button, Get get, Set set)
  {
    this->bindValue(button, &QAbstractButton::toggled, get, set, &QAbstractButton::setChecked);
  }
  /// Binds the index of the item.
  template <class Get, class Set>
  void bind(QComboBox* box, Get get, Set set)
  {
    this->bindValue(box, QOverload<int>::of(&QComboBox::currentIndexChanged), get, set, &QComboBox::setCurrentIndex);
  }
  /// Binds the text stored as the item's data; the first item represents any other text.
  template <class Get, class Set>
  void bindData(QComboBox* box, Get get, Set set)
  {
    this->bindText(
      box, QOverload<int>::of(&QComboBox::currentIndexChanged), get, set,
      [box] { return box->currentData().toString(); },
      [box](const QString& text) { box->setCurrentIndex(std::max(0, box->findData(text))); });
  }
  /// `edited` is the signal on which the node is updated: QLineEdit::textChanged or QLineEdit::editingFinished.
  template <class Signal, class Get, class Set>
  void bind(QLineEdit* edit, Signal edited, Get get, Set set)
  {
    this->bindText(
      edit, edited, get, set, [edit] { return edit->text(); }, [edit](const QString& text) { edit->setText(text); });
  }
  template <class Get, class Set>
  void bind(ctkPathLineEdit* edit, Get get, Set set)
  {
    this->bindText(
      edit, &ctkPathLineEdit::currentPathChanged, get, set, [edit] { return edit->currentPath(); },
      [edit](const QString& path) { edit->setCurrentPath(path); });
  }

  /// Binds the single node of a role.
  void bind(qMRMLNodeComboBox* box, const char* role)
  {
    QObject::connect(box, QOverload<vtkMRMLNode*>::of(&qMRMLNodeComboBox::currentNodeChanged), box,
                     [this, role](vtkMRMLNode* node)
                     {
                       if (this->isListening()) this->Parameters->SetNode(role, node);
                     });
    // By default, the box would select a neighbouring node, which the next run could overwrite.
    QObject::connect(box, &qMRMLNodeComboBox::nodeAboutToBeRemoved, box,
                     [box](vtkMRMLNode* node)
                     {
                       if (box->currentNode() == node) box->setCurrentNode(nullptr);
                     });
    // A node created with the box is shown before a run fills it.
    QObject::connect(box->nodeFactory(), &qMRMLNodeFactory::nodeInitialized, box, giveOneVoxel);
    this->onShow([this, box, role] { box->setCurrentNode(this->Parameters->GetNodeReference(role)); });
  }
  /// Binds all nodes of a role.
  void bind(qMRMLCheckableNodeComboBox* box, const char* role)
  {
    QObject::connect(box, &qMRMLCheckableNodeComboBox::checkedNodesChanged, box,
                     [this, box, role]
                     {
                       if (!this->isListening()) return;
                       const QList<vtkMRMLNode*> checked = box->checkedNodes();
                       this->Parameters->SetNodes(role, { checked.begin(), checked.end() });
                     });
    this->onShow(
      [this, box, role]
      {
        const std::vector<vtkMRMLNode*> chosen = this->Parameters->GetNodes(role);
        for (vtkMRMLNode* node : box->nodes())
        {
          const bool isChosen = std::find(chosen.begin(), chosen.end(), node) != chosen.end();
          const Qt::CheckState state = isChosen ? Qt::Checked : Qt::Unchecked;
          if (box->checkState(node) != state) box->setCheckState(node, state);
        }
      });
  }

  /// Adds an action that follows the node, after the controls bound before; the node is then not null.
  void onShow(std::function<void()> show) { m_Shown.push_back(std::move(show)); }

  /// Updates the controls from the node, which must not be null; meanwhile, no control writes to the node.
  void show()
  {
    const QScopedValueRollback<bool> showing(m_IsShowing, true);
    for (const auto& show : m_Shown) show();
  }

  /// Whether a change of a control is user input that must be written to the node.
  bool isListening() const { return this->Parameters && !m_IsShowing; }

private:
  template <class Control, class Signal, class Get, class Set, class Show>
  void bindValue(Control* control, Signal changed, Get get, Set set, Show show)
  {
    QObject::connect(control, changed, control,
                     [this, set](auto value)
                     {
                       if (this->isListening()) (this->Parameters->*set)(value);
                     });
    this->onShow([this, control, get, show] { (control->*show)((this->Parameters->*get)()); });
  }

  template <class Control, class Signal, class Get, class Set, class Read, class Show>
  void bindText(Control* control, Signal changed, Get get, Set set, Read read, Show show)
  {
    QObject::connect(control, changed, control,
                     [this, set, read]
                     {
                       if (this->isListening()) (this->Parameters->*set)(read().toStdString());
                     });
    this->onShow(
      [this, get, read, show]
      {
        const QString text = QString::fromStdString((this->Parameters->*get)());
        if (read() != text) show(text); // leaves the cursor in place if the text is unchanged
      });
  }

  std::vector<std::function<void()>> m_Shown;
  bool m_IsShowing = false;
};

} // namespace surgicalmesher
