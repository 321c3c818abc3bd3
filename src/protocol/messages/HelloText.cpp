// SPDX-License-Identifier: Apache-2.0
#include "HelloText.h"

#include "MessageTable.h"

#include <QtCore/QJsonDocument>

namespace qplc::messages {

namespace {

QByteArray endWith(const QPlcSignalTable &table)
{
    const QJsonObject field{{QStringLiteral("table"), QString::fromUtf8(table.toIni())}};
    return QJsonDocument(field).toJson(QJsonDocument::Compact).replace(0, 1, ",");
}

}  // namespace

HelloText::HelloText(const QPlcSignalTable &table)
    : m_end(endWith(table))
{
}

QByteArray HelloText::withTable(const MasterHello &hello) const
{
    return withoutTable(hello).chopped(1) + m_end;
}

QByteArray HelloText::withoutTable(const MasterHello &hello)
{
    return jsonOf(toMessage(hello)).toJson(QJsonDocument::Compact);
}

}  // namespace qplc::messages
