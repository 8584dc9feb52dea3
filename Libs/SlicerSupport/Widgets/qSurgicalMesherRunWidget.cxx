// SPDX-License-Identifier: Apache-2.0
#include "qSurgicalMesherRunWidget.h"

#include "vtkSurgicalMesherRun.h"

#include <qSlicerCLIProgressBar.h>

#include <vtkSmartPointer.h>

#include <QHBoxLayout>
#include <QLabel>
#include <QPushButton>
#include <QStyle>
#include <QTimer>
#include <QVBoxLayout>

//-----------------------------------------------------------------------------
class qSurgicalMesherRunWidgetPrivate
{
  Q_DECLARE_PUBLIC(qSurgicalMesherRunWidget)

public:
  explicit qSurgicalMesherRunWidgetPrivate(qSurgicalMesherRunWidget& object) : q_ptr(&object) {}

  void setupUi();
  void update();
  void updateElapsedTime();
  void showSentence();
  QString errorSentence() const;
  bool isBusy() const { return this->Run && this->Run->IsBusy(); }

  qSurgicalMesherRunWidget* const q_ptr;
  QLabel* Icon = nullptr;
  QLabel* Sentence = nullptr;
  QPushButton* FixButton = nullptr;
  QPushButton* ApplyButton = nullptr;
  QPushButton* CancelButton = nullptr;
  QLabel* ElapsedTime = nullptr;
  qSlicerCLIProgressBar* ProgressBar = nullptr;
  QTimer Clock;

  QString Problem;
  QString Result;
  std::function<void()> Fix;
  vtkSmartPointer<vtkSurgicalMesherRun> Run;
};

//-----------------------------------------------------------------------------
void qSurgicalMesherRunWidgetPrivate::setupUi()
{
  Q_Q(qSurgicalMesherRunWidget);
  auto* layout = new QVBoxLayout(q);
  layout->setContentsMargins(0, 0, 0, 0);

  auto* sentenceLine = new QHBoxLayout;
  this->Icon = new QLabel(q);
  this->Icon->setObjectName("RunIcon");
  this->Sentence = new QLabel(q);
  this->Sentence->setObjectName("RunSentence");
  this->Sentence->setWordWrap(true);
  this->Sentence->setTextInteractionFlags(Qt::TextSelectableByMouse);
  this->FixButton = new QPushButton(q);
  this->FixButton->setObjectName("FixButton");
  sentenceLine->addWidget(this->Icon);
  sentenceLine->addWidget(this->Sentence, 1);
  sentenceLine->addWidget(this->FixButton);
  layout->addLayout(sentenceLine);

  auto* buttonLine = new QHBoxLayout;
  this->ApplyButton = new QPushButton(qSurgicalMesherRunWidget::tr("Apply"), q);
  this->ApplyButton->setObjectName("ApplyButton");
  this->ApplyButton->setToolTip(qSurgicalMesherRunWidget::tr("Run the module; Slicer stays usable meanwhile."));
  this->CancelButton = new QPushButton(qSurgicalMesherRunWidget::tr("Cancel"), q);
  this->CancelButton->setObjectName("CancelButton");
  this->CancelButton->setToolTip(qSurgicalMesherRunWidget::tr("End the run; nothing of it stays in the scene."));
  buttonLine->addWidget(this->ApplyButton, 2);
  buttonLine->addWidget(this->CancelButton, 1);
  layout->addLayout(buttonLine);

  this->ProgressBar = new qSlicerCLIProgressBar(q);
  this->ProgressBar->setObjectName("RunProgressBar");
  this->ProgressBar->setStatusVisibility(qSlicerCLIProgressBar::AlwaysHidden);
  this->ProgressBar->setProgressVisibility(qSlicerCLIProgressBar::AlwaysVisible);
  layout->addWidget(this->ProgressBar);
  this->ElapsedTime = new QLabel(q);
  this->ElapsedTime->setObjectName("ElapsedTime");
  layout->addWidget(this->ElapsedTime);

  for (QWidget* widget : { static_cast<QWidget*>(this->Sentence), static_cast<QWidget*>(this->ElapsedTime) })
  {
    widget->setAccessibleName(qSurgicalMesherRunWidget::tr("State of the run"));
  }
  QWidget::setTabOrder(this->FixButton, this->ApplyButton);
  QWidget::setTabOrder(this->ApplyButton, this->CancelButton);

  this->Clock.setInterval(500);
  QObject::connect(&this->Clock, &QTimer::timeout, q, [this] { this->updateElapsedTime(); });
  QObject::connect(this->FixButton, &QPushButton::clicked, q,
                   [this]
                   {
                     const std::function<void()> fix = this->Fix; // the call may replace this->Fix
                     if (fix) fix();
                   });
  QObject::connect(this->ApplyButton, &QPushButton::clicked, q, &qSurgicalMesherRunWidget::apply);
  QObject::connect(this->CancelButton, &QPushButton::clicked, q, &qSurgicalMesherRunWidget::cancel);
}

QString qSurgicalMesherRunWidgetPrivate::errorSentence() const
{
  if (!this->Run || this->Run->GetStatus() != vtkSurgicalMesherRun::Failed) return QString();
  const QString reason = QString::fromStdString(this->Run->GetErrorText());
  return reason.isEmpty() ? qSurgicalMesherRunWidget::tr("The module ended before its time.")
                          : qSurgicalMesherRunWidget::tr("The module failed: %1").arg(reason);
}

/// A current problem takes precedence over the outcome of the last run.
void qSurgicalMesherRunWidgetPrivate::showSentence()
{
  Q_Q(qSurgicalMesherRunWidget);
  QString text = this->Problem;
  QStyle::StandardPixmap icon = QStyle::SP_MessageBoxInformation;
  if (text.isEmpty())
  {
    text = this->errorSentence();
    if (!text.isEmpty()) icon = QStyle::SP_MessageBoxWarning;
  }
  if (text.isEmpty()) text = this->Result;
  if (text.isEmpty() && this->Run && this->Run->GetStatus() == vtkSurgicalMesherRun::Cancelled)
    text = qSurgicalMesherRunWidget::tr("Cancelled.");
  if (this->isBusy()) text.clear();
  const int size = q->style()->pixelMetric(QStyle::PM_SmallIconSize);
  this->Icon->setPixmap(q->style()->standardIcon(icon).pixmap(size, size));
  this->Sentence->setText(text);
  this->Icon->setVisible(!text.isEmpty());
  this->Sentence->setVisible(!text.isEmpty());
  this->FixButton->setVisible(!text.isEmpty() && !this->Problem.isEmpty() && this->Fix);
}

void qSurgicalMesherRunWidgetPrivate::update()
{
  const bool isBusy = this->isBusy();
  this->showSentence();
  this->ApplyButton->setEnabled(!isBusy && this->Problem.isEmpty());
  this->CancelButton->setEnabled(isBusy);
  this->ProgressBar->setCommandLineModuleNode(isBusy ? this->Run->GetCommandLineNode() : nullptr);
  this->ProgressBar->setVisible(isBusy);
  this->ElapsedTime->setVisible(isBusy);
  this->updateElapsedTime();
  if (isBusy && !this->Clock.isActive()) this->Clock.start();
  if (!isBusy) this->Clock.stop();
}

void qSurgicalMesherRunWidgetPrivate::updateElapsedTime()
{
  const int seconds = this->Run ? int(this->Run->GetElapsedSeconds()) : 0;
  this->ElapsedTime->setText(
    qSurgicalMesherRunWidget::tr("Running for %1:%2").arg(seconds / 60).arg(seconds % 60, 2, 10, QLatin1Char('0')));
}

//-----------------------------------------------------------------------------
qSurgicalMesherRunWidget::qSurgicalMesherRunWidget(QWidget* parent)
  : QWidget(parent), d_ptr(new qSurgicalMesherRunWidgetPrivate(*this))
{
  Q_D(qSurgicalMesherRunWidget);
  d->setupUi();
  d->update();
}

qSurgicalMesherRunWidget::~qSurgicalMesherRunWidget() { this->qvtkDisconnectAll(); }

void qSurgicalMesherRunWidget::setProblem(const QString& sentence, const QString& fixText, std::function<void()> fix)
{
  Q_D(qSurgicalMesherRunWidget);
  d->Problem = sentence;
  d->Fix = fixText.isEmpty() ? std::function<void()>() : std::move(fix);
  d->FixButton->setText(fixText);
  d->update();
}

void qSurgicalMesherRunWidget::clearProblem() { this->setProblem(QString()); }

QString qSurgicalMesherRunWidget::problem() const
{
  Q_D(const qSurgicalMesherRunWidget);
  return d->Problem;
}

void qSurgicalMesherRunWidget::setRun(vtkSurgicalMesherRun* run)
{
  Q_D(qSurgicalMesherRunWidget);
  this->qvtkReconnect(d->Run, run, vtkSurgicalMesherRun::StatusChangedEvent, this, SLOT(onRunStatusChanged()));
  this->qvtkReconnect(d->Run, run, vtkSurgicalMesherRun::CompletedEvent, this, SIGNAL(runEnded()));
  d->Run = run;
  d->Result.clear();
  d->update();
}

vtkSurgicalMesherRun* qSurgicalMesherRunWidget::run() const
{
  Q_D(const qSurgicalMesherRunWidget);
  return d->Run;
}

void qSurgicalMesherRunWidget::setResult(const QString& sentence)
{
  Q_D(qSurgicalMesherRunWidget);
  d->Result = sentence;
  d->update();
}

void qSurgicalMesherRunWidget::apply()
{
  Q_D(qSurgicalMesherRunWidget);
  if (d->isBusy() || !d->Problem.isEmpty()) return;
  d->Result.clear();
  emit this->applyRequested();
}

void qSurgicalMesherRunWidget::cancel()
{
  Q_D(qSurgicalMesherRunWidget);
  if (!d->isBusy()) return;
  d->CancelButton->setEnabled(false);
  d->Run->Cancel();
  emit this->cancelRequested();
}

void qSurgicalMesherRunWidget::onRunStatusChanged()
{
  Q_D(qSurgicalMesherRunWidget);
  d->update();
}
