// SPDX-License-Identifier: Apache-2.0
#include "Logging.h"

Q_LOGGING_CATEGORY(lcMaster, "qtplc.master", QtInfoMsg)
Q_LOGGING_CATEGORY(lcSlave, "qtplc.slave", QtInfoMsg)
Q_LOGGING_CATEGORY(lcAudit, "qtplc.audit", QtInfoMsg)
Q_LOGGING_CATEGORY(lcControl, "qtplc.control", QtWarningMsg)
Q_LOGGING_CATEGORY(lcCyclic, "qtplc.cyclic", QtWarningMsg)

namespace qplc {

QString printable(QString text)
{
    for (QChar &character : text) {
        if (character.category() == QChar::Other_Control)
            character = QLatin1Char('?');
    }
    return text;
}

QString firstOf(const QStringList &names)
{
    constexpr int most = 8;
    const QString text = names.mid(0, most).join(QStringLiteral(", "));
    return names.size() > most ? text + QStringLiteral(" and %1 more").arg(names.size() - most) : text;
}

}  // namespace qplc
