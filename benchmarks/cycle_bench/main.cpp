// SPDX-License-Identifier: Apache-2.0
// qtplc_cycle_bench: measures the cycle of one master process with N slave processes, and prints
// one line of JSON.
#include "BenchMaster.h"

#include <QtCore/QJsonDocument>
#include <QtCore/QLoggingCategory>

#include <cstdio>

namespace {

int runSlave(QPlcCoreApplication &application, const BenchOptions &options)
{
    QString error;
    const QPlcUnderlyingProtocol master
        = QPlcUnderlyingProtocol::fromString(options.master, QPlcUnderlyingProtocol::Udp, &error);
    BenchSlave slave(options, options.slaveIndex);
    QPlcRealTimeOptions realTime;
    realTime.spin = qint64(options.spinUs) * 1000;
    slave.setRealTimeOptions(realTime);
    if (!options.keys.isEmpty())
        slave.setSecurity(QPlcSecurity::preSharedKeys(options.keys, slave.name()));
    if (!master.isValid()) {
        QPlcCoreApplication::printError(error);
        return QPlcCoreApplication::Failure;
    }
    slave.setReconnectPolicy(QPlcSlaveNode::ReconnectAlways);  // many may be too many at a time
    slave.connectToMaster(master);
    return application.exec();
}

int runMaster(const BenchOptions &options)
{
    BenchMaster master(options);
    if (!master.run()) {
        QPlcCoreApplication::printError(master.errorString());
        return QPlcCoreApplication::Failure;
    }
    std::puts(QJsonDocument(master.result()).toJson(QJsonDocument::Compact).constData());
    return QPlcCoreApplication::Success;
}

}  // namespace

int main(int argc, char **argv)
{
    QPlcCoreApplication application(argc, argv);
    QLoggingCategory::setFilterRules(QStringLiteral("qtplc.*.info=false"));
    BenchOptions options;
    if (!readBenchOptions(application, &options))
        return application.exitCode();
    return options.isSlave() ? runSlave(application, options) : runMaster(options);
}
