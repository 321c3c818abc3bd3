// SPDX-License-Identifier: Apache-2.0
#include "MasterSearch.h"

#include <QtCore/QEvent>
#include <QtWidgets/QWidget>

namespace qplc {

MasterSearch::MasterSearch(QObject *parent)
    : QObject(parent)
{
    setObjectName(QStringLiteral("MasterSearch"));
    connect(&m_finder, &MasterFinder::changed, this, [this] { Q_EMIT found(m_finder.masters()); });
}

void MasterSearch::watch(QWidget *place)
{
    place->installEventFilter(this);
}

void MasterSearch::setSilent(bool isSilent)
{
    m_isSilent = isSilent;
    if (isSilent)
        m_finder.stop();
}

bool MasterSearch::eventFilter(QObject *place, QEvent *event)
{
    if (event->type() == QEvent::Show)
        begin(place);
    else if (event->type() == QEvent::Hide)
        end(place);
    return false;
}

void MasterSearch::begin(QObject *place)
{
    m_visible.insert(place);
    if (m_isSilent)
        return;
    m_finder.start();
    Q_EMIT found(m_finder.masters());  // not those of the last time
}

/// Tells nobody: \a place may be on its way out.
void MasterSearch::end(QObject *place)
{
    m_visible.remove(place);
    if (m_visible.isEmpty())
        m_finder.stop();
}

}  // namespace qplc
