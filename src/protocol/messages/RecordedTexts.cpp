// SPDX-License-Identifier: Apache-2.0
#include "RecordedTexts.h"

#include <QtCore/QJsonDocument>

namespace qplc::messages {

QByteArray lineOf(const QJsonObject &object)
{
    return QJsonDocument(object).toJson(QJsonDocument::Compact);
}

}  // namespace qplc::messages
