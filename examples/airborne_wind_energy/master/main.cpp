// SPDX-License-Identifier: Apache-2.0
#include "ExampleOptions.h"
#include "FlightReportText.h"
#include "FlightRun.h"

#include <QtNetwork/QNetworkInterface>

#include <algorithm>
#include <cstdio>

namespace {

struct MasterSettings
{
    awe::RunSettings run;
    QHostAddress address;
    quint16 port = 0;
    QHostAddress multicastGroup;  // null: none
    QPlcRealTimeOptions realTime;
    QPlcProfile::Value profile = QPlcProfile::Automatic;
    QPlcManifest manifest;
    double initializationTimeout = 2.0;  // [s]
    QString faultPlan;
    QPlcSecurity security;
};

void addMasterOptions(QPlcCoreApplication &application)
{
    application.addOption(QCommandLineOption(QStringLiteral("signals"),
                                             QStringLiteral("Signal table. Without one that of the example."),
                                             QStringLiteral("FILE"), awe::builtInSignals()));
    application.addOption(QCommandLineOption(
        QStringLiteral("listen"),
        QStringLiteral("Address to listen on. Without it 127.0.0.1: only this computer reaches the master."),
        QStringLiteral("ADDRESS"), QStringLiteral("127.0.0.1")));
    application.addOption(QCommandLineOption(
        QStringLiteral("port"),
        QStringLiteral("Port to listen on. 0: a free one. Without it %1.").arg(QPlcUnderlyingProtocol::DefaultPort),
        QStringLiteral("PORT"), QString::number(QPlcUnderlyingProtocol::DefaultPort)));
    application.addOption(
        QCommandLineOption(QStringLiteral("multicast"),
                           QStringLiteral("Multicast group for nodes at udp-multicast://..., for example %1: one "
                                          "datagram carries the inputs of all of them. Without it there is none.")
                               .arg(awe::defaultMulticastGroup().toString()),
                           QStringLiteral("ADDRESS")));
    application.addOption(QCommandLineOption(
        QStringLiteral("insecure-network"),
        QStringLiteral(
            "Lets --listen open the plant to the network without --security: everybody there can command it.")));
    application.addSecurityOptions(QPlcSecurity::MasterSide);
    application.addOption(QCommandLineOption(
        QStringLiteral("no-arming"),
        QStringLiteral(
            "Lets one message start the plant. Without it a start has to be armed before, with --security.")));
    application.addOption(QCommandLineOption(
        QStringLiteral("beacon"),
        QStringLiteral("Tells the network of --listen every 2 s where this master is, for qtplc find and windows.")));
    application.addOption(QCommandLineOption(
        QStringLiteral("start-with"),
        QStringLiteral(
            "Starts as soon as these nodes are there, and ends with the flight. Without it: by qtplc start, stop."),
        QStringLiteral("NODE,...")));
    application.addOption(QCommandLineOption(
        QStringLiteral("stay"),
        QStringLiteral("With --start-with: does not end with the flight, but waits for qtplc start, stop.")));
    awe::addRunOptions(application, QStringLiteral("0"), awe::DefaultClock::LockstepWithStartWith);
    awe::addPlantOptions(application);
    application.addOption(
        QCommandLineOption(QStringLiteral("mean-wind"),
                           QStringLiteral("Wind speed that eta is related to [m/s]. 0: what the signals show."),
                           QStringLiteral("SPEED"), QStringLiteral("0")));
    application.addProfileOption();
    application.addManifestOption();
    application.addEventOption();
    application.addOption(QCommandLineOption(
        QStringLiteral("initialization-timeout"),
        QStringLiteral("Longest wait for each answer of a node while it is initialized or started [s]."),
        QStringLiteral("SECONDS"), QStringLiteral("2")));
    application.addRealTimeOptions();
    application.addFaultOptions();
}

/// Whether a program can listen on \a address: on one of the interfaces, or on all of them.
bool isAddressOfThisComputer(const QHostAddress &address)
{
    if (address.isLoopback() || address == QHostAddress::AnyIPv4 || address == QHostAddress::AnyIPv6)
        return true;
    const auto withoutInterface = [](QHostAddress one) {
        one.setScopeId(QString());
        return one;
    };
    const QList<QHostAddress> own = QNetworkInterface::allAddresses();
    return std::any_of(own.begin(), own.end(),
                       [&](const QHostAddress &one) { return withoutInterface(one) == withoutInterface(address); });
}

/// \return false, with the message out, if the options name an invalid address, or open the plant
///         to the network without security
bool readAddresses(QPlcCoreApplication &application, MasterSettings *settings)
{
    const QString listen = application.value(QStringLiteral("listen"));
    if (!settings->address.setAddress(listen)) {
        application.usageError(QStringLiteral("--listen %1: use an IP address, for example 127.0.0.1").arg(listen));
        return false;
    }
    if (!settings->address.isLoopback() && settings->security.isNone()
        && !application.isSet(QStringLiteral("insecure-network"))) {
        application.usageError(QStringLiteral("--listen %1: everybody in that network could command the plant; use "
                                              "--security psk --keys FILE, or allow it by --insecure-network")
                                   .arg(listen));
        return false;
    }
    if (!isAddressOfThisComputer(settings->address)) {
        application.usageError(
            QStringLiteral("--listen %1: this computer has no such address; 'ip address' shows those that it has")
                .arg(listen));
        return false;
    }
    if (!application.isSet(QStringLiteral("multicast")))
        return true;
    const QString group = application.value(QStringLiteral("multicast"));
    if (settings->multicastGroup.setAddress(group) && settings->multicastGroup.isMulticast()
        && settings->multicastGroup.protocol() == QAbstractSocket::IPv4Protocol)
        return true;
    application.usageError(QStringLiteral("--multicast '%1': use an IPv4 multicast address, for example %2")
                               .arg(group, awe::defaultMulticastGroup().toString()));
    return false;
}

bool readMasterOptions(QPlcCoreApplication &application, MasterSettings *settings)
{
    qint64 port = 0;
    if (!awe::readRunOptions(application, &settings->run) || !awe::readPlantOptions(application, &settings->run.plant)
        || !application.integer(QStringLiteral("port"), 0, 65535, &port)
        || !application.number(QStringLiteral("mean-wind"), 0.0, 100.0, &settings->run.nominalWindSpeed)
        || !application.number(QStringLiteral("initialization-timeout"), 0.001, 3600.0,
                               &settings->initializationTimeout)
        || !application.readProfile(&settings->profile) || !application.readManifest(&settings->manifest)
        || !application.readRealTimeOptions(&settings->realTime)
        || !application.readSecurityOptions(QPlcSecurity::MasterSide, &settings->security)
        || !application.readFaultPlan(&settings->faultPlan))
        return false;
    settings->port = quint16(port);
    settings->run.stay = application.isSet(QStringLiteral("stay"));
    // By hand a person wants to watch: the clock runs like the real one unless told otherwise.
    settings->run.awaitedNodes
        = application.value(QStringLiteral("start-with")).split(QLatin1Char(','), Qt::SkipEmptyParts);
    if (settings->run.awaitedNodes.isEmpty() && !application.isSet(QStringLiteral("lockstep"))
        && !application.isSet(QStringLiteral("scale")) && !application.isSet(QStringLiteral("external")))
        settings->run.clock = QPlcClock::realTime();
    return readAddresses(application, settings);
}

}  // namespace

int main(int argc, char **argv)
{
    QPlcCoreApplication application(argc, argv);
    application.setDescription(
        QStringLiteral("The master of the airborne wind energy example: cycle clock and values of all signals."));
    application.setExamples(
        {QStringLiteral("awe_master &  awe_model &  awe_autopilot &  qtplc start"),
         QStringLiteral("awe_master --lockstep --duration 600 --start-with Model,Autopilot --report flight.json"),
         QStringLiteral("awe_master --multicast %1 &  awe_model --master udp-multicast://localhost &  awe_autopilot "
                        "--master udp-multicast://localhost &  qtplc start")
             .arg(awe::defaultMulticastGroup().toString()),
         QStringLiteral("sudo chrt -f 49 awe_master")});
    addMasterOptions(application);
    MasterSettings settings;
    if (!application.parseOptions() || !readMasterOptions(application, &settings))
        return application.exitCode();
    QPlcSignalIndexTable table;
    if (!table.initializeFromIniFile(application.value(QStringLiteral("signals"))))
        return application.usageError(table.errorString());
    if (!awe::addOptionSignals(application, settings.run.plant.options))
        return application.exitCode();

    QPlcMasterNode master;
    master.setRealTimeOptions(settings.realTime);
    master.setProfile(settings.profile);
    application.readEventOption(&master);
    if (!settings.manifest.isEmpty())
        master.setManifest(settings.manifest);
    master.setInitializationTimeout(std::chrono::milliseconds(qRound64(settings.initializationTimeout * 1e3)));
    master.setInsecureNetworkAllowed(application.isSet(QStringLiteral("insecure-network")));
    master.setSecurity(settings.security);
    if (application.isSet(QStringLiteral("no-arming")))
        master.setArmingRequired(false);
    master.setMulticastGroup(settings.multicastGroup);
    master.setFaultPlan(settings.faultPlan);
    master.setBeacon(application.isSet(QStringLiteral("beacon")));
    QPlcServiceNotifier service(master);
    awe::FlightRun run(master, settings.run);
    application.quitOnSignals([&run] { run.end(); });  // before anybody hears that it is ready
    if (!run.isValid() || !master.startServer(QPlcUnderlyingProtocol::tcp(settings.address, settings.port)))
        return QPlcCoreApplication::UsageError;
    std::printf("port %d\n", int(master.serverPort()));
    std::fflush(stdout);
    service.setReady();

    QObject::connect(&run, &awe::FlightRun::finished, &application, [&](int exitCode) {
        if (!run.report().isEmpty())
            std::fputs(qPrintable(awe::summary(run.report())), stdout);
        QCoreApplication::exit(exitCode);
    });
    run.begin();
    return QCoreApplication::exec();
}
