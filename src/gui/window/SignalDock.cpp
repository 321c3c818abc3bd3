// SPDX-License-Identifier: Apache-2.0
#include "SignalDock.h"

#include "QPlcSignalTree.h"

namespace qplc {

SignalDock::SignalDock(WindowContext *context, QWidget *parent)
    : QDockWidget(tr("Signals"), parent)
    , m_tree(new QPlcSignalTree(this))
{
    setObjectName(QStringLiteral("SignalDock"));
    m_tree->setContext(context);
    setWidget(m_tree);
}

void SignalDock::startSearch()
{
    show();
    raise();
    m_tree->startSearch();
}

}  // namespace qplc
