// SPDX-License-Identifier: Apache-2.0
#include "View3DEditor.h"

#include <QtWidgets/QAction>
#include <QtWidgets/QCheckBox>
#include <QtWidgets/QComboBox>
#include <QtWidgets/QDoubleSpinBox>
#include <QtWidgets/QFileDialog>
#include <QtWidgets/QFormLayout>
#include <QtWidgets/QGridLayout>
#include <QtWidgets/QLineEdit>
#include <QtWidgets/QStyle>
#include <QtWidgets/QVBoxLayout>

namespace qplc {

QString cameraTitle(OrbitCamera::Preset preset)
{
    switch (preset) {
    case OrbitCamera::GroundStation:
        return View3DEditor::tr("Ground station");
    case OrbitCamera::Side:
        return View3DEditor::tr("Side");
    case OrbitCamera::Top:
        return View3DEditor::tr("Top");
    case OrbitCamera::Downwind:
        return View3DEditor::tr("Downwind");
    case OrbitCamera::Chase:
        return View3DEditor::tr("Chase");
    }
    return {};
}

View3DEditor::View3DEditor(const View3DSettings &settings, const QVector<View3DPart> &parts, QWidget *body)
    : m_settings(settings)
{
    auto *layout = new QVBoxLayout(this);
    layout->setContentsMargins(0, 0, 0, 0);
    auto *form = new QFormLayout;
    form->setContentsMargins(9, 9, 9, body ? 0 : 9);
    addCamera(form);
    form->addRow(tr("Show"), makeShow(parts));
    addScale(form);
    addModel(form);
    layout->addLayout(form);
    if (body) {
        layout->addWidget(body);
        return;
    }
    addSignal(form, tr("Position"), &View3DSettings::position);
    addSignal(form, tr("Orientation"), &View3DSettings::orientation);
}

View3DEditor::~View3DEditor()
{
    for (QLineEdit *line : findChildren<QLineEdit *>())  // one that loses the focus now must write nothing
        line->disconnect(this);
}

void View3DEditor::addCamera(QFormLayout *form)
{
    auto *choice = new QComboBox;
    for (int i = 0; i < OrbitCamera::presets; ++i)
        choice->addItem(tr("%1 (%2)").arg(cameraTitle(OrbitCamera::Preset(i))).arg(i + 1));
    choice->setCurrentIndex(m_settings.camera.preset);
    choice->setAccessibleName(tr("Camera"));
    form->addRow(tr("Camera"), choice);
    connect(choice, QOverload<int>::of(&QComboBox::activated), this, [this](int preset) {
        m_settings.camera = OrbitCamera();
        m_settings.camera.preset = OrbitCamera::Preset(preset);
        Q_EMIT edited();
    });
}

QWidget *View3DEditor::makeShow(const QVector<View3DPart> &parts)
{
    auto *all = new QWidget;
    auto *grid = new QGridLayout(all);
    grid->setContentsMargins(0, 0, 0, 0);
    int place = 0;
    for (const View3DPart &part : parts) {
        auto *box = new QCheckBox(part.title);
        box->setChecked(m_settings.isShown(part.key));
        grid->addWidget(box, place / 2, place % 2);
        ++place;
        connect(box, &QCheckBox::toggled, this, [this, key = part.key](bool isOn) {
            m_settings.setShown(key, isOn);
            Q_EMIT edited();
        });
    }
    return all;
}

void View3DEditor::addSignal(QFormLayout *form, const QString &label, QString View3DSettings::*member)
{
    auto *edit = new QLineEdit(m_settings.*member);
    edit->setPlaceholderText(tr("no signal"));
    edit->setAccessibleName(label);
    form->addRow(label, edit);
    connect(edit, &QLineEdit::editingFinished, this, [this, edit, member] {
        if (m_settings.*member == edit->text().trimmed())
            return;
        m_settings.*member = edit->text().trimmed();
        Q_EMIT edited();
    });
}

void View3DEditor::addScale(QFormLayout *form)
{
    auto *scale = new QDoubleSpinBox;
    scale->setRange(0.0, View3DSettings::largestBodyScale);
    scale->setDecimals(1);
    scale->setPrefix(tr("× "));
    scale->setSpecialValueText(tr("as large as needed"));
    scale->setKeyboardTracking(false);
    scale->setValue(m_settings.bodyScale);
    scale->setAccessibleName(tr("Size of the model"));
    form->addRow(tr("Size of the model"), scale);
    connect(scale, QOverload<double>::of(&QDoubleSpinBox::valueChanged), this, [this](double value) {
        m_settings.bodyScale = value;
        Q_EMIT edited();
    });
}

void View3DEditor::addModel(QFormLayout *form)
{
    auto *edit = new QLineEdit(m_settings.model);
    edit->setPlaceholderText(tr("that of the view"));
    edit->setAccessibleName(tr("Model file"));
    form->addRow(tr("Model (OBJ file)"), edit);
    const auto take = [this, edit] {
        if (m_settings.model == edit->text().trimmed())
            return;
        m_settings.model = edit->text().trimmed();
        Q_EMIT edited();
    };
    connect(edit, &QLineEdit::editingFinished, this, take);
    QAction *choose = edit->addAction(style()->standardIcon(QStyle::SP_DirOpenIcon), QLineEdit::TrailingPosition);
    choose->setText(tr("Choose a model file"));
    connect(choose, &QAction::triggered, this, [this, edit, take] {
        auto *dialog = new QFileDialog(this, tr("Model file"), edit->text(), tr("Wavefront OBJ (*.obj)"));
        dialog->setAttribute(Qt::WA_DeleteOnClose);
        connect(dialog, &QFileDialog::fileSelected, this, [edit, take](const QString &file) {
            edit->setText(file);
            take();
        });
        dialog->open();
    });
}

}  // namespace qplc
