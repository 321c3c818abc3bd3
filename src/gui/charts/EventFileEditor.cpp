// SPDX-License-Identifier: Apache-2.0
#include "EventFileEditor.h"

#include <QtCore/QSignalBlocker>
#include <QtWidgets/QCheckBox>
#include <QtWidgets/QFileDialog>
#include <QtWidgets/QFormLayout>
#include <QtWidgets/QHBoxLayout>
#include <QtWidgets/QLineEdit>
#include <QtWidgets/QSpinBox>
#include <QtWidgets/QToolButton>

namespace qplc {

EventFileEditor::EventFileEditor(QWidget *parent)
    : QWidget(parent)
    , m_on(new QCheckBox(tr("Save each event as CSV"), this))
    , m_folder(new QLineEdit(this))
    , m_most(new QSpinBox(this))
{
    auto *choose = new QToolButton(this);
    choose->setText(QStringLiteral("…"));
    choose->setToolTip(tr("Choose a folder"));
    choose->setAccessibleName(choose->toolTip());
    m_folder->setPlaceholderText(EventFileSettings::usualFolder());
    m_folder->setAccessibleName(tr("Folder of saved events"));
    m_folder->setMinimumWidth(m_folder->fontMetrics().averageCharWidth() * 28);
    m_most->setRange(1, EventFileSettings::LargestMost);
    m_most->setAccessibleName(tr("Most files in the folder"));
    m_most->setKeyboardTracking(false);
    auto *line = new QHBoxLayout;
    line->addWidget(m_folder, 1);
    line->addWidget(choose);
    auto *form = new QFormLayout(this);
    form->setContentsMargins(0, 0, 0, 0);
    form->addRow(m_on);
    form->addRow(tr("Folder"), line);
    form->addRow(tr("Most files"), m_most);
    connect(m_on, &QCheckBox::toggled, this, &EventFileEditor::take);
    connect(m_folder, &QLineEdit::editingFinished, this, &EventFileEditor::take);
    connect(m_most, QOverload<int>::of(&QSpinBox::valueChanged), this, &EventFileEditor::take);
    connect(choose, &QToolButton::clicked, this, &EventFileEditor::chooseFolder);
    show(m_settings);
}

void EventFileEditor::show(const EventFileSettings &settings)
{
    m_settings = settings;
    const QSignalBlocker on(m_on);
    const QSignalBlocker most(m_most);
    m_on->setChecked(settings.isOn);
    m_folder->setText(settings.folder);
    m_most->setValue(settings.most);
}

void EventFileEditor::take()
{
    const EventFileSettings wanted{m_on->isChecked(), m_folder->text().trimmed(), m_most->value()};
    if (wanted == m_settings)
        return;
    m_settings = wanted;
    Q_EMIT edited();
}

void EventFileEditor::chooseFolder()
{
    auto *dialog = new QFileDialog(window()->parentWidget(), tr("Folder of saved events"), m_settings.usedFolder());
    dialog->setAttribute(Qt::WA_DeleteOnClose);
    dialog->setFileMode(QFileDialog::Directory);
    dialog->setOption(QFileDialog::ShowDirsOnly);
    connect(dialog, &QFileDialog::fileSelected, this, [this](const QString &folder) {
        m_folder->setText(folder);
        take();
    });
    dialog->open();
}

}  // namespace qplc
