// SPDX-License-Identifier: Apache-2.0
#include "Commands.h"
#include "CrashReport.h"
#include "QPlcFmuNode.h"
#include "QPlcNodeApplication.h"
#include "realtime/EndSignal.h"

#include <QtCore/QTimer>

namespace fmu {

namespace {

constexpr std::chrono::seconds longestEnd{5};
constexpr std::chrono::seconds longestStandstill{10};  // of the event loop

/// A node whose crash is told in any thread.
class CoveredNode final : public QPlcFmuNode
{
public:
    ~CoveredNode() override { disconnectFromMaster(); }

private:
    void outputs() override
    {
        CrashReport::coverThread();
        QPlcFmuNode::outputs();
    }
    void update(const QPlcCycle &cycle) override
    {
        CrashReport::coverThread();
        QPlcFmuNode::update(cycle);
    }
};

/// SIGTERM comes while the event loop may wait for the FMU. More signals do not prolong the time.
void endAfterSignal()
{
    qplc::atEndSignal = nullptr;
    CrashReport::endAfter(longestEnd);
}

void expectLoop()
{
    if (qplc::atEndSignal.load())
        CrashReport::expectAgainWithin(longestStandstill);
}

QString termText(const QString &source, const QPlcFmuNode::Wire &wire)
{
    QString text = source;
    if (wire.factor != 1.0)
        text += QStringLiteral(" * %1").arg(wire.factor);
    if (wire.offset != 0.0)
        text += QStringLiteral(" %1 %2")
                    .arg(wire.offset < 0.0 ? QLatin1Char('-') : QLatin1Char('+'))
                    .arg(qAbs(wire.offset));
    return text;
}

void printWires(const QPlcFmuNode &node)
{
    print(QStringLiteral("%1: model %2, FMI %3").arg(node.name(), node.modelName(), node.fmiVersion()));
    if (node.wires().isEmpty())
        print(QStringLiteral("  inputs and outputs are the signals of the same name"));
    for (const QPlcFmuNode::Wire &wire : node.wires()) {
        const bool isInput = wire.direction == QPlcPort::Input;
        print(QStringLiteral("  %1 %2 %3")
                  .arg(termText(isInput ? wire.signal : wire.variable, wire), -36)
                  .arg(isInput ? QStringLiteral("-> variable") : QStringLiteral("-> signal"),
                       isInput ? wire.variable : wire.signal));
    }
}

}  // namespace

int runNode(int argc, char **argv)
{
    QPlcNodeApplication application(argc, argv);
    application.setDescription(QStringLiteral("Runs an FMU as a node of a plant. The configuration names the FMU, its "
                                              "start values, and the signals of its variables; without one, inputs and "
                                              "outputs are the signals of the same name."));
    application.setExamples({QStringLiteral("qtplc_fmu node model.ini --master 192.168.1.5 --stay"),
                             QStringLiteral("qtplc_fmu node model.fmu"),
                             QStringLiteral("qtplc_fmu node model.ini --check")});
    application.addPositionalArgument(QStringLiteral("command"), QStringLiteral("The word 'node'."),
                                      QStringLiteral("node"));
    application.addPositionalArgument(QStringLiteral("file"), QStringLiteral("Configuration file, or an FMU."),
                                      QStringLiteral("FILE"));
    application.addOption({QStringLiteral("check"),
                           QStringLiteral("Reads the configuration, loads the FMU, shows the wires, and ends.")});
    if (!application.parseNodeOptions())
        return application.exitCode();
    if (application.positionalArguments().size() != 2)
        return application.usageError(QStringLiteral("name one configuration or FMU: qtplc_fmu node model.ini"));
    // Before the node, which waits for the FMU then.
    QObject::connect(&application, &QCoreApplication::aboutToQuit, [] { CrashReport::endAfter(longestEnd); });
    CoveredNode node;
    if (!node.configureFromFile(application.positionalArguments().at(1)))
        return application.usageError(QPlcParseError::toString(node.configurationErrors()));
    if (application.isSet(QStringLiteral("check"))) {
        printWires(node);
        return QPlcNodeApplication::Success;
    }
    // An FMU that does not return would keep the process for ever when the connection is lost.
    qplc::atEndSignal = &endAfterSignal;
    QTimer beat;
    QObject::connect(&beat, &QTimer::timeout, &expectLoop);
    beat.start(1000);
    const int code = application.run(node);
    beat.stop();
    CrashReport::endAfter(longestEnd);
    return code;
}

}  // namespace fmu
