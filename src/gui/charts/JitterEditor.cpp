// SPDX-License-Identifier: Apache-2.0
#include "JitterEditor.h"

#include "JitterDistributions.h"

#include <QtWidgets/QCheckBox>
#include <QtWidgets/QComboBox>
#include <QtWidgets/QLabel>
#include <QtWidgets/QRadioButton>
#include <QtWidgets/QVBoxLayout>

namespace qplc {

JitterEditor::JitterEditor(const QStringList &keys, const QStringList &shown, bool isLast, QWidget *parent)
    : QWidget(parent)
{
    auto *all = new QVBoxLayout(this);
    auto *start = new QRadioButton(tr("Since the start"));
    auto *last = new QRadioButton(tr("Only the last 10 s"));
    (isLast ? last : start)->setChecked(true);
    connect(last, &QRadioButton::toggled, this, &JitterEditor::lastChanged);
    all->addWidget(start);
    all->addWidget(last);
    all->addSpacing(8);
    all->addWidget(new QLabel(tr("Histograms")));
    for (const QString &key : keys) {
        auto *box = new QCheckBox(JitterDistribution::titleOf(key));
        box->setChecked(shown.contains(key));
        connect(box, &QCheckBox::toggled, this, [this, key](bool isShown) { Q_EMIT shownChanged(key, isShown); });
        all->addWidget(box);
    }
    all->addStretch(1);
}

void JitterEditor::addPlants(const QStringList &plants, const QString &plant)
{
    auto *choice = new QComboBox;
    choice->setAccessibleName(tr("Plant"));
    choice->addItem(tr("The selected one"), QString());
    for (const QString &name : plants)
        choice->addItem(name, name);
    if (choice->findData(plant) < 0)
        choice->addItem(tr("%1, which is not there").arg(plant), plant);
    choice->setCurrentIndex(choice->findData(plant));
    connect(choice, QOverload<int>::of(&QComboBox::activated), this,
            [this, choice] { Q_EMIT plantChanged(choice->currentData().toString()); });
    auto *all = qobject_cast<QVBoxLayout *>(layout());
    all->insertWidget(0, new QLabel(tr("Plant")));
    all->insertWidget(1, choice);
    all->insertSpacing(2, 8);
}

}  // namespace qplc
