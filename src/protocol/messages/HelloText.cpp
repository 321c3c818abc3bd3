// SPDX-License-Identifier: Apache-2.0
#include "HelloText.h"

#include "MessageTable.h"

#include <QtCore/QJsonDocument>

namespace qplc::messages {

namespace {

QByteArray textOf(const QPlcSignalTable &table)
{
    const QJsonObject field{{QStringLiteral("table"), QString::fromUtf8(table.toIni())}};
    return QJsonDocument(field).toJson(QJsonDocument::Compact).replace(0, 1, ",");
}

}  // namespace

HelloText::HelloText(const QPlcSignalTable &table)
    : m_table(textOf(table))
{
}

QByteArray HelloText::beforeTable(const MasterHello &hello)
{
    return withoutTable(hello).chopped(1);
}

QByteArray HelloText::withoutTable(const MasterHello &hello)
{
    return jsonOf(toMessage(hello)).toJson(QJsonDocument::Compact);
}

}  // namespace qplc::messages
