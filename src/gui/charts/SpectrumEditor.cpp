// SPDX-License-Identifier: Apache-2.0
#include "SpectrumEditor.h"

#include <QtWidgets/QCheckBox>
#include <QtWidgets/QComboBox>
#include <QtWidgets/QFormLayout>
#include <QtWidgets/QHBoxLayout>
#include <QtWidgets/QLabel>
#include <QtWidgets/QLineEdit>
#include <QtWidgets/QPushButton>
#include <QtWidgets/QToolButton>

namespace qplc {

SpectrumEditor::SpectrumEditor(const QStringList &references, const QJsonObject &settings, QWidget *parent)
    : SettingsEditor(parent)
    , m_settings(settings)
    , m_rows(new QVBoxLayout)
{
    auto *all = new QVBoxLayout(this);
    auto *form = new QFormLayout;
    all->addLayout(form);
    addChoice(form, tr("Show"), QStringLiteral("show"),
              {{tr("Amplitudes"), QStringLiteral("amplitude")},
               {tr("Power density (Welch)"), QStringLiteral("density")},
               {tr("Spectrogram"), QStringLiteral("spectrogram")}});
    addChoice(form, tr("Window"), QStringLiteral("window"),
              {{tr("Hann"), QStringLiteral("hann")},
               {tr("Flat top: right amplitudes"), QStringLiteral("flatTop")},
               {tr("Rectangular: whole periods"), QStringLiteral("rectangular")}});
    QVector<Choice> lengths{{tr("Automatic"), 0}};
    for (int length = 64; length <= 65536; length *= 2)
        lengths.append({tr("%1 values").arg(length), length});
    addChoice(form, tr("Segments"), QStringLiteral("segment"), lengths);
    addChoice(form, tr("Overlap"), QStringLiteral("overlap"),
              {{QStringLiteral("0 %"), 0}, {QStringLiteral("50 %"), 50}, {QStringLiteral("75 %"), 75}});
    addBox(all, tr("Logarithmic frequency"), QStringLiteral("logFrequency"));
    addBox(all, tr("Logarithmic values"), QStringLiteral("logValues"));
    all->addWidget(new QLabel(tr("Signals")));
    all->addLayout(m_rows);
    for (const QString &reference : references)
        addRow(reference);
    auto *add = new QPushButton(tr("Add a signal"));
    connect(add, &QPushButton::clicked, this, [this] { addRow({}); });
    all->addWidget(add, 0, Qt::AlignLeft);
    all->addStretch(1);
}

/// A value of a layout that is no choice is one more.
void SpectrumEditor::addChoice(QFormLayout *form, const QString &label, const QString &key,
                               const QVector<Choice> &choices)
{
    auto *box = new QComboBox;
    box->setAccessibleName(label);
    const QJsonValue now = m_settings.value(key);
    for (const Choice &choice : choices) {
        box->addItem(choice.text, choice.value);
        if (choice.value == now)
            box->setCurrentIndex(box->count() - 1);
    }
    if (box->currentData().toJsonValue() != now) {
        box->addItem(now.toVariant().toString(), now);
        box->setCurrentIndex(box->count() - 1);
    }
    form->addRow(label, box);
    connect(box, QOverload<int>::of(&QComboBox::activated), this,
            [this, box, key] { Q_EMIT settingChanged(key, box->currentData().toJsonValue()); });
}

void SpectrumEditor::addBox(QVBoxLayout *all, const QString &text, const QString &key)
{
    auto *box = new QCheckBox(text);
    box->setChecked(m_settings.value(key).toBool());
    connect(box, &QCheckBox::toggled, this, [this, key](bool isOn) { Q_EMIT settingChanged(key, isOn); });
    all->addWidget(box);
}

void SpectrumEditor::addRow(const QString &reference)
{
    auto *row = new QWidget;
    auto *line = new QHBoxLayout(row);
    line->setContentsMargins(0, 0, 0, 0);
    QLineEdit *field = makeText(tr("Signal"), reference, [this](const QString &) { tellSignals(); });
    field->setPlaceholderText(QStringLiteral("power, = derivative(tetherLength)"));
    field->setMinimumWidth(220);
    auto *remove = new QToolButton;
    remove->setText(QStringLiteral("×"));
    remove->setAccessibleName(tr("Remove this signal"));
    remove->setToolTip(remove->accessibleName());
    line->addWidget(field);
    line->addWidget(remove);
    m_rows->addWidget(row);
    connect(remove, &QToolButton::clicked, this, [this, row] {
        m_rows->removeWidget(row);
        row->deleteLater();
        tellSignals();
    });
}

void SpectrumEditor::tellSignals()
{
    QStringList references;
    for (int i = 0; i < m_rows->count(); ++i) {
        const QString text = m_rows->itemAt(i)->widget()->findChild<QLineEdit *>()->text().trimmed();
        if (!text.isEmpty())
            references << text;
    }
    Q_EMIT signalsChanged(references);
}

}  // namespace qplc
