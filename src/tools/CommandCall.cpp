// SPDX-License-Identifier: Apache-2.0
#include "Commands.h"

namespace tools {

bool CommandCall::tell(bool succeeded) const
{
    if (!succeeded)
        QPlcCoreApplication::printError(client.errorString());
    return succeeded;
}

bool CommandCall::connect() const
{
    client.control().leaveTableOut();
    return tell(client.connectToMaster(master));
}

bool CommandCall::connect(QPlcSignalTable *table) const
{
    if (!tell(client.connectToMaster(master)))
        return false;
    *table = client.table();
    if (table->isEmpty())
        QPlcCoreApplication::printError(client.errorString());
    return !table->isEmpty();
}

int CommandCall::exitCode() const
{
    switch (client.error()) {
    case BlockingClient::NoError:
        return application.exitCode();
    case BlockingClient::Unreachable:
        return QPlcCoreApplication::UsageError;
    case BlockingClient::Refused:
    case BlockingClient::Lost:
        break;
    }
    return QPlcCoreApplication::Failure;
}

std::shared_ptr<const bool> CommandCall::quitOnSignals() const
{
    const auto isWanted = std::make_shared<bool>(false);
    application.quitOnSignals([isWanted] {
        *isWanted = true;
        QCoreApplication::quit();
    });
    return isWanted;
}

QStringList CommandCall::listOf(const char *option) const
{
    return application.value(QLatin1String(option)).split(QLatin1Char(','), Qt::SkipEmptyParts);
}

bool CommandCall::readNumber(const char *option, double minimum, double maximum, double *result) const
{
    const QString name = QString::fromLatin1(option);
    return !application.isSet(name) || application.number(name, minimum, maximum, result);
}

bool CommandCall::readInteger(const char *option, qint64 minimum, qint64 maximum, qint64 *result) const
{
    const QString name = QString::fromLatin1(option);
    return !application.isSet(name) || application.integer(name, minimum, maximum, result);
}

}  // namespace tools
