// SPDX-License-Identifier: Apache-2.0
#include "JitterEditor.h"

#include "JitterDistributions.h"

#include <QtWidgets/QCheckBox>
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

}  // namespace qplc
