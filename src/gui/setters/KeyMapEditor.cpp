// SPDX-License-Identifier: Apache-2.0
#include "KeyMapEditor.h"
#include "gui/panel/SignalEdit.h"

#include "Gamepad.h"
#include "KeyButton.h"
#include "gui/panel/NumberBox.h"

#include <QtWidgets/QComboBox>
#include <QtWidgets/QGridLayout>
#include <QtWidgets/QLabel>
#include <QtWidgets/QLineEdit>
#include <QtWidgets/QToolButton>
#include <QtWidgets/QVBoxLayout>

namespace qplc {

namespace {

constexpr double largestValue = 1e9;

}  // namespace

KeyMapEditor::KeyMapEditor(const ManualBindings &bindings, QPlcPanelContext *context, QWidget *parent)
    : SettingsEditor(parent)
    , m_bindings(bindings)
    , m_context(context)
    , m_column(new QVBoxLayout(this))
{
    m_column->setContentsMargins(0, 0, 0, 0);
    rebuild();
}

void KeyMapEditor::rebuild()
{
    if (m_content) {
        const QList<QObject *> parts = m_content->findChildren<QObject *>();
        for (QObject *part : parts)
            part->disconnect(this);  // hiding ends an edit, of a row that may be no more
        m_content->hide();
        m_content->deleteLater();  // a button of it may be at work
    }
    m_content = new QWidget(this);
    auto *grid = new QGridLayout(m_content);
    grid->setContentsMargins(0, 0, 0, 0);
    m_column->addWidget(m_content);
    for (int i = 0; i < m_bindings.keys.size(); ++i)
        addKeyRow(grid, i);
    for (int i = 0; i < m_bindings.axes.size(); ++i)
        addAxisRow(grid, i);
    addButton(tr("Add a key"), [this] { m_bindings.keys.append(KeyBinding()); });
    addButton(tr("Add an axis"), [this] {
        AxisBinding axis;
        axis.axis = AxisBinding::axes().first();
        m_bindings.axes.append(axis);
    });
    if (!m_bindings.axes.isEmpty())
        addNote(grid, Gamepad().absence());
    m_content->show();
    if (isVisible() && parentWidget())
        parentWidget()->adjustSize();
}

void KeyMapEditor::addKeyRow(QGridLayout *grid, int place)
{
    const int row = grid->rowCount();
    auto *key = new KeyButton(m_bindings.keys.at(place).key, m_content);
    connect(key, &KeyButton::keyChanged, this, [this, place](int wanted) {
        m_bindings.keys[place].key = wanted;
        changed();
    });
    grid->addWidget(key, row, 0);
    addSignalField(
        grid, row, 1, [ this, place ]() -> auto & { return m_bindings.keys[place].signal; });
    addNumber(
        grid, row, 2, tr("Value"), [ this, place ]() -> auto & { return m_bindings.keys[place].value; }, -largestValue,
        largestValue);
    addRemove(grid, row, 5, [this, place] { m_bindings.keys.remove(place); });
}

void KeyMapEditor::addAxisRow(QGridLayout *grid, int place)
{
    const int row = grid->rowCount();
    auto *axis = new QComboBox(m_content);
    axis->addItems(AxisBinding::axes());
    axis->setCurrentText(m_bindings.axes.at(place).axis);
    axis->setAccessibleName(tr("Axis"));
    connect(axis, &QComboBox::currentTextChanged, this, [this, place](const QString &text) {
        m_bindings.axes[place].axis = text;
        changed();
    });
    grid->addWidget(axis, row, 0);
    addSignalField(
        grid, row, 1, [ this, place ]() -> auto & { return m_bindings.axes[place].signal; });
    addNumber(
        grid, row, 2, tr("Value at full deflection"),
        [ this, place ]() -> auto & { return m_bindings.axes[place].value; }, -largestValue, largestValue);
    addNumber(
        grid, row, 3, tr("Dead zone"), [ this, place ]() -> auto & { return m_bindings.axes[place].deadZone; }, 0.0,
        0.9);
    addNumber(
        grid, row, 4, tr("Expo"), [ this, place ]() -> auto & { return m_bindings.axes[place].expo; }, 0.0, 1.0);
    addRemove(grid, row, 5, [this, place] { m_bindings.axes.remove(place); });
}

void KeyMapEditor::addSignalField(QGridLayout *grid, int row, int column,
                                  const std::function<SignalReference &()> &signal)
{
    auto *field = new SignalEdit(m_context, SignalEdit::AllSignals, m_content);
    field->setText(signal().toString());
    field->setMinimumWidth(170);
    connect(field, &QLineEdit::editingFinished, this, [this, field, signal] {
        const SignalReference wanted = SignalReference::fromString(field->text());
        if (wanted == signal())
            return;
        signal() = wanted;
        changed();
    });
    grid->addWidget(field, row, column);
}

void KeyMapEditor::addNumber(QGridLayout *grid, int row, int column, const QString &name,
                             const std::function<double &()> &number, double smallest, double largestNumber)
{
    auto *field = new NumberBox(smallest, largestNumber, m_content);
    field->setMinimumWidth(64);
    field->setMaximumWidth(90);
    field->setValue(number());
    field->setToolTip(name);
    field->setAccessibleName(name);
    connect(field, qOverload<double>(&NumberBox::valueChanged), this, [this, number](double value) {
        number() = value;
        changed();
    });
    grid->addWidget(field, row, column);
}

void KeyMapEditor::addRemove(QGridLayout *grid, int row, int column, const std::function<void()> &remove)
{
    auto *button = new QToolButton(m_content);
    button->setText(QStringLiteral("×"));
    button->setAccessibleName(tr("Remove this row"));
    button->setToolTip(button->accessibleName());
    connect(button, &QToolButton::clicked, this, [this, remove] {
        remove();
        changed();
        rebuild();
    });
    grid->addWidget(button, row, column);
}

/// \param text  empty: none
void KeyMapEditor::addNote(QGridLayout *grid, const QString &text)
{
    if (text.isEmpty())
        return;
    auto *note = new QLabel(text, m_content);
    note->setEnabled(false);  // muted
    grid->addWidget(note, grid->rowCount() - 1, 1, 1, 5, Qt::AlignRight);
}

void KeyMapEditor::addButton(const QString &text, const std::function<void()> &add)
{
    auto *button = new QPushButton(text, m_content);
    auto *grid = static_cast<QGridLayout *>(m_content->layout());
    connect(button, &QPushButton::clicked, this, [this, add] {
        add();
        rebuild();  // what has no signal yet changes nothing
    });
    grid->addWidget(button, grid->rowCount(), 0, 1, 2);
}

}  // namespace qplc
