// SPDX-License-Identifier: Apache-2.0
#include "StoredEvent.h"

#include <QtCore/QJsonDocument>

namespace qplc::messages {

QByteArray StoredEvent::toLine() const
{
    return QJsonDocument(toObject(*this)).toJson(QJsonDocument::Compact) + '\n';
}

bool StoredEvent::fromLine(const QByteArray &line)
{
    QString error;
    return fromObject(QJsonDocument::fromJson(line).object(), this, &error);
}

}  // namespace qplc::messages
