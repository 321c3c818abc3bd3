// SPDX-License-Identifier: Apache-2.0
#include "XyPlotEditor.h"

#include <QtWidgets/QCheckBox>
#include <QtWidgets/QHBoxLayout>
#include <QtWidgets/QLabel>
#include <QtWidgets/QLineEdit>
#include <QtWidgets/QPushButton>
#include <QtWidgets/QToolButton>

namespace qplc {

namespace {

QLineEdit *addField(QHBoxLayout *row, const QString &name, const QString &text)
{
    auto *field = new QLineEdit(text);
    field->setAccessibleName(name);
    field->setPlaceholderText(QStringLiteral("%1: kite.azimuth, = mean(power, 5)").arg(name));
    field->setMinimumWidth(190);
    row->addWidget(field);
    return field;
}

}  // namespace

XyPlotEditor::XyPlotEditor(const QVector<Expressions> &curves, bool isEqual, QWidget *parent)
    : SettingsEditor(parent)
    , m_rows(new QVBoxLayout)
{
    auto *all = new QVBoxLayout(this);
    all->addWidget(new QLabel(tr("Curves, x and y")));
    all->addLayout(m_rows);
    for (const Expressions &curve : curves)
        addRow(curve);
    auto *add = new QPushButton(tr("Add a curve"));
    connect(add, &QPushButton::clicked, this, [this] {
        addRow({});
        Q_EMIT curveAdded();
    });
    all->addWidget(add, 0, Qt::AlignLeft);
    auto *equal = new QCheckBox(tr("Same length of a unit on both axes"));
    equal->setChecked(isEqual);
    connect(equal, &QCheckBox::toggled, this, &XyPlotEditor::equalAspectChanged);
    all->addWidget(equal);
    all->addStretch(1);
}

void XyPlotEditor::addRow(const Expressions &expressions)
{
    auto *row = new QWidget;
    auto *line = new QHBoxLayout(row);
    line->setContentsMargins(0, 0, 0, 0);
    QLineEdit *x = addField(line, tr("x"), expressions.x);
    QLineEdit *y = addField(line, tr("y"), expressions.y);
    auto *remove = new QToolButton;
    remove->setText(QStringLiteral("×"));
    remove->setAccessibleName(tr("Remove this curve"));
    remove->setToolTip(remove->accessibleName());
    line->addWidget(remove);
    m_rows->addWidget(row);
    for (QLineEdit *field : {x, y}) {
        connect(field, &QLineEdit::editingFinished, this, [this, row, field, x, y] {
            if (!field->isModified())
                return;
            field->setModified(false);
            Q_EMIT expressionChanged(m_rows->indexOf(row), x->text().trimmed(), y->text().trimmed());
        });
    }
    connect(remove, &QToolButton::clicked, this, [this, row] { removeRow(row); });
}

void XyPlotEditor::removeRow(QWidget *row)
{
    const int curve = m_rows->indexOf(row);
    m_rows->removeWidget(row);
    row->deleteLater();
    Q_EMIT curveRemoved(curve);
}

}  // namespace qplc
