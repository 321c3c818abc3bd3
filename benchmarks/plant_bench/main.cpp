// SPDX-License-Identifier: Apache-2.0
// Processor time of a window that hears all signals of a plant, keeps them, and shows some of them
// in a tree. The plant is a process of its own.
#include "gui/models/SignalTreeModel.h"

#include <QtPlcCore>

#include <QtCore/QCommandLineParser>
#include <QtCore/QJsonDocument>
#include <QtCore/QJsonObject>
#include <QtCore/QProcess>
#include <QtCore/QSocketNotifier>
#include <QtWidgets/QApplication>
#include <QtWidgets/QTreeView>

#include <cstdio>
#include <sys/resource.h>

namespace {

QPlcSignalTable tableOf(int count)
{
    QPlcSignalTable table;
    for (int i = 0; i < count; ++i) {
        QPlcSignalDefinition definition;
        definition.name = QStringLiteral("signal%1").arg(i, 4, 10, QLatin1Char('0'));
        definition.type = i % 4 == 0 ? QPlcSignalType(QPlcSignalType::Real32) : QPlcSignalType(QPlcSignalType::Real64);
        definition.unit = QStringLiteral("m/s");
        table.append(definition);
    }
    return table;
}

/// Writes every signal in every cycle.
class Waves : public QPlcCompactSlaveNode
{
public:
    explicit Waves(const QPlcSignalTable &table)
        : QPlcCompactSlaveNode(QStringLiteral("Waves"))
    {
        for (const QPlcSignalDefinition &definition : table) {
            if (definition.type.scalar() == QPlcSignalType::Real32)
                m_singles.push_back(std::make_unique<QPlcOutput<float>>(this, definition.name.toLatin1().constData()));
            else
                m_doubles.push_back(std::make_unique<QPlcOutput<double>>(this, definition.name.toLatin1().constData()));
        }
    }

private:
    void reset() override {}
    void step(const QPlcCycle &cycle) override
    {
        const double time = double(cycle.number());
        for (std::size_t i = 0; i < m_singles.size(); ++i)
            *m_singles[i] = float(time + double(i));
        for (std::size_t i = 0; i < m_doubles.size(); ++i)
            *m_doubles[i] = 0.001 * time - double(i);
    }
    std::vector<std::unique_ptr<QPlcOutput<float>>> m_singles;
    std::vector<std::unique_ptr<QPlcOutput<double>>> m_doubles;
};

struct Options
{
    int signalCount = 420;
    double rate = 100.0;    // [Hz]
    double seconds = 10.0;  // [s]
    bool hasTree = true;
};

/// The plant: prints its port, and runs until its standard input ends.
int runPlant(const Options &options)
{
    const QPlcSignalTable table = tableOf(options.signalCount);
    QPlcMasterNode master;
    Waves waves(table);
    const bool isRunning = master.setSignalTable(table) && master.setInterval(1.0 / options.rate)
        && master.startServer(QPlcUnderlyingProtocol::tcp(QHostAddress::LocalHost, 0)) && master.addLocalNode(&waves)
        && master.startRealTime();
    if (!isRunning) {
        std::fprintf(stderr, "%s\n", qPrintable(master.errorString()));
        return 1;
    }
    std::printf("%d\n", int(master.serverPort()));
    std::fflush(stdout);
    QSocketNotifier end(0, QSocketNotifier::Read);
    QObject::connect(&end, &QSocketNotifier::activated, qApp, &QCoreApplication::quit);
    const int code = QCoreApplication::exec();
    master.stop();
    master.removeLocalNode(&waves);
    return code;
}

double processorTime()
{
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    return double(usage.ru_utime.tv_sec + usage.ru_stime.tv_sec)
        + double(usage.ru_utime.tv_usec + usage.ru_stime.tv_usec) * 1e-6;
}

long residentMemory()
{
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    return usage.ru_maxrss / 1024;
}

void wait(double seconds)
{
    QEventLoop loop;
    QTimer::singleShot(int(seconds * 1e3), &loop, &QEventLoop::quit);
    loop.exec();
}

int runWindow(const Options &options, const QString &address)
{
    qplc::PlantList plants;
    qplc::SignalTreeModel model(&plants);
    QTreeView view;
    view.setUniformRowHeights(true);
    view.setModel(&model);
    view.resize(600, 900);
    if (options.hasTree)
        view.show();
    qplc::Plant *plant = plants.add(address);
    wait(2.0);
    view.expandAll();
    wait(0.5);
    int updates = 0;
    int changes = 0;
    QObject::connect(plant, &qplc::Plant::updated, plant, [&] { ++updates; });
    QObject::connect(&model, &QAbstractItemModel::dataChanged, plant, [&] { ++changes; });
    QElapsedTimer clock;
    clock.start();
    const double begin = processorTime();
    const quint64 rows = plant->values().rows();
    wait(options.seconds);
    const double elapsed = double(clock.nsecsElapsed()) * 1e-9;
    const double used = processorTime() - begin;
    const QJsonObject result{
        {QStringLiteral("signals"), options.signalCount},
        {QStringLiteral("rate"), options.rate},
        {QStringLiteral("tree"), options.hasTree},
        {QStringLiteral("seconds"), elapsed},
        {QStringLiteral("rows"), double(plant->values().rows() - rows)},
        {QStringLiteral("gaps"), double(plant->values().gaps())},
        {QStringLiteral("updates"), updates},
        {QStringLiteral("treeChanges"), changes},
        {QStringLiteral("cpu"), used / elapsed},
        {QStringLiteral("memoryMiB"), double(residentMemory())},
    };
    std::printf("%s\n", QJsonDocument(result).toJson(QJsonDocument::Compact).constData());
    return plant->values().rows() > rows ? 0 : 1;
}

/// Starts this program again as the plant.
int run(const Options &options)
{
    QProcess plant;
    plant.setProcessChannelMode(QProcess::ForwardedErrorChannel);
    plant.start(QCoreApplication::applicationFilePath(),
                {QStringLiteral("--plant"), QStringLiteral("--signals"), QString::number(options.signalCount),
                 QStringLiteral("--rate"), QString::number(options.rate)});
    if (!plant.waitForReadyRead(10000)) {
        std::fprintf(stderr, "the plant does not begin\n");
        return 1;
    }
    const int code
        = runWindow(options, QStringLiteral("127.0.0.1:%1").arg(QString::fromLatin1(plant.readLine().trimmed())));
    plant.closeWriteChannel();
    plant.waitForFinished(5000);
    return code;
}

}  // namespace

int main(int argc, char **argv)
{
    QApplication application(argc, argv);
    QCommandLineParser parser;
    parser.addHelpOption();
    parser.addOptions(
        {{QStringLiteral("signals"), QStringLiteral("number of signals"), QStringLiteral("n"), QStringLiteral("420")},
         {QStringLiteral("rate"), QStringLiteral("cycles per second"), QStringLiteral("Hz"), QStringLiteral("100")},
         {QStringLiteral("seconds"), QStringLiteral("how long to measure"), QStringLiteral("s"), QStringLiteral("10")},
         {QStringLiteral("no-tree"), QStringLiteral("hear and keep only")},
         {QStringLiteral("plant"), QStringLiteral("be the plant (started by the program itself)")}});
    parser.process(application);
    Options options;
    options.signalCount = parser.value(QStringLiteral("signals")).toInt();
    options.rate = parser.value(QStringLiteral("rate")).toDouble();
    options.seconds = parser.value(QStringLiteral("seconds")).toDouble();
    options.hasTree = !parser.isSet(QStringLiteral("no-tree"));
    return parser.isSet(QStringLiteral("plant")) ? runPlant(options) : run(options);
}
