// SPDX-License-Identifier: Apache-2.0
#include "WindVane.h"

int main(int argc, char **argv)
{
    QPlcNodeApplication application(argc, argv);
    application.setDescription(QStringLiteral("The weather station: a wind vane on a serial line."));
    application.addPositionalArgument(QStringLiteral("configuration"), QStringLiteral("What is wired to what."));
    if (!application.parseNodeOptions())
        return application.exitCode();
    QPlcHardwareNode::addDriverKind(QStringLiteral("vane"), QStringLiteral("wind vane that says its angle"),
                                    [] { return std::make_unique<WindVane>(); });
    QPlcHardwareNode node;
    if (!node.configureFromFile(application.positionalArguments().value(0)))
        return application.usageError(QPlcParseError::toString(node.configurationErrors()));
    return application.run(node);
}
