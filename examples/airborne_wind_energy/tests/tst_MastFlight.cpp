// SPDX-License-Identifier: Apache-2.0
#include "AutopilotNode.h"
#include "CompactModelNode.h"
#include "ExampleOptions.h"
#include "FlightObserver.h"
#include "OptionSignals.h"

#include <QtCore/QFile>
#include <QtCore/QJsonArray>
#include <QtCore/QJsonObject>
#include <QtCore/QTemporaryDir>
#include <QtCore/QUuid>
#include <QtTest/QtTest>

#include <memory>

using namespace awe;

namespace {

constexpr int second = 100;      // [cycles]
constexpr int patience = 20000;  // [ms] with a connection, far more than a loaded machine needs

/// Master, model, autopilot and observer of a plant, cycle by cycle.
class Flight
{
public:
    explicit Flight(const QString &plant)
    {
        m_isReady = PlantConfiguration::read(plant, &m_plant, &m_error) && begin();
        if (m_error.isEmpty())
            m_error = m_master.errorString();
    }
    ~Flight()
    {
        m_master.stop();
        for (QPlcSlaveNode *node :
             {static_cast<QPlcSlaveNode *>(m_observer.get()), static_cast<QPlcSlaveNode *>(m_model.get()),
              static_cast<QPlcSlaveNode *>(m_autopilot.get())}) {
            if (node)
                m_master.removeLocalNode(node);
        }
    }

    bool isReady() const { return m_isReady; }
    QString error() const { return m_error; }
    QPlcMasterNode &master() { return m_master; }

    void fly(int cycles)
    {
        for (int i = 0; i < cycles; ++i)
            m_master.step();
    }
    /// Flies until \a phase begins. \return false when it does not within \a seconds
    bool reaches(FlightPhase phase, int seconds)
    {
        for (int i = 0; i < seconds * second && this->phase() != phase; ++i)
            m_master.step();
        return this->phase() == phase;
    }
    bool request(FlightRequest request)
    {
        return m_master.setSignalValue(QString::fromLatin1(flightRequestSignal), int(request));
    }

    double value(const char *signal) const { return m_master.signalValue(QString::fromLatin1(signal)).toReal(); }
    FlightPhase phase() const { return FlightPhase(int(value("flightPhase"))); }
    bool isDocked() const { return value(mastDockedSignal) != 0.0; }
    bool hasCrashed() const { return value("crashed") != 0.0; }
    /// Ends the flight.
    FlightReport report()
    {
        m_master.stop();
        return m_observer->report();
    }

private:
    bool begin()
    {
        QPlcSignalTable table = QPlcSignalTable::fromIniFile(builtInSignals());
        if (!addOptionSignals(m_plant.options, &table, &m_error))
            return false;
        QPlcSignalIndexTable::setCurrent(table);
        const WindParameters &wind = m_plant.kite.wind;
        AutopilotGains gains;
        gains.mast = m_plant.gainsOfMast();
        m_model = std::make_unique<CompactModelNode>(
            KiteSimulation(m_plant.kite.plantIn(wind), wind, 1, m_plant.optionsIn(wind)));
        m_autopilot = std::make_unique<AutopilotNode>(gains);
        m_observer = std::make_unique<FlightObserver>(FlightStatisticsParameters(), m_plant);
        m_master.setClock(QPlcClock::external());
        return m_master.setInterval(std::chrono::milliseconds(10)) && m_master.addLocalNode(m_observer.get())
            && m_master.addLocalNode(m_model.get()) && m_master.addLocalNode(m_autopilot.get())
            && m_master.startServer(QPlcUnderlyingProtocol::tcp(QHostAddress::LocalHost, 0))
            && m_master.startRealTime();
    }

    PlantConfiguration m_plant;
    QPlcMasterNode m_master;
    std::unique_ptr<CompactModelNode> m_model;
    std::unique_ptr<AutopilotNode> m_autopilot;
    std::unique_ptr<FlightObserver> m_observer;
    QString m_error;
    bool m_isReady = false;
};

/// An operator with a connection of its own.
class Operator
{
public:
    bool connectTo(QPlcMasterNode &master)
    {
        QObject::connect(&m_socket, &QPlcAbstractSocket::messageReceived, &m_socket,
                         [this](const QPlcMessage &message) { m_answers.append(message); });
        m_socket.connectToMaster(QPlcUnderlyingProtocol::tcp(QHostAddress::LocalHost, master.serverPort()));
        return QTest::qWaitFor([this] { return m_socket.isConnected(); }, patience)
            && ask(QPlcMessage::Hello,
                   {{"protocol", 2},
                    {"name", "Anna"},
                    {"uuid", QUuid::createUuid().toString(QUuid::WithoutBraces)},
                    {"role", "tool"},
                    {"features", QJsonArray()}})
            == QPlcMessage::Hello;
    }
    /// \return the kind of the answer
    QPlcMessage::Kind ask(QPlcMessage::Kind kind, const QJsonObject &fields)
    {
        m_answers.clear();
        m_socket.sendMessage(QPlcMessage(kind, fields));
        return QTest::qWaitFor([this] { return !m_answers.isEmpty(); }, patience) ? m_answers.first().kind()
                                                                                  : QPlcMessage::Failed;
    }
    bool takeRequest(FlightRequest request)
    {
        const QString name = QString::fromLatin1(flightRequestSignal), value = QString::number(int(request));
        return ask(QPlcMessage::TakeLease,
                   {{"signals", QJsonArray{name}}, {"values", QJsonObject{{name, value}}}, {"timeout", 3.6e12}})
            == QPlcMessage::Done;
    }
    void vanish() { m_socket.abort(); }

private:
    QPlcMasterSocket m_socket;
    QVector<QPlcMessage> m_answers;
};

}  // namespace

/// A kite at a mast, through the nodes of the example, with an operator who wants this and that.
class tst_MastFlight : public QObject
{
    Q_OBJECT

private Q_SLOTS:
    void kiteStartsAndLandsByItself();
    void requestLandsTheKiteInTheMiddleOfReelingOut();
    void requestToLandKeepsTheKiteAtTheMast();
    void changingRequestsAreHarmless_data();
    void changingRequestsAreHarmless();
    void plantWithoutAMastHasNoRequest();
    void lostOperatorMeansLand();

private:
    QString write(const QByteArray &text);

    QTemporaryDir m_folder;
};

QString tst_MastFlight::write(const QByteArray &text)
{
    QFile file(m_folder.filePath(QStringLiteral("plant.ini")));
    return file.open(QIODevice::WriteOnly) && file.write(text) == text.size() ? file.fileName() : QString();
}

/// The wind falls from 8 to 5 m/s after some minutes.
void tst_MastFlight::kiteStartsAndLandsByItself()
{
    Flight flight(write("[kite]\nwind = 8,0,0\ngustAmplitude = -0.4\ngustStart = 240\ngustDuration = 800\n"
                        "[mast]\nkind = fixed\n"));
    QVERIFY2(flight.isReady(), qPrintable(flight.error()));
    flight.fly(59 * second);
    QVERIFY(flight.isDocked());
    QCOMPARE(flight.phase(), FlightPhase::Docked);
    QCOMPARE(flight.value("tetherLength"), 12.0);
    QVERIFY(flight.reaches(FlightPhase::Ascend, 2));
    QVERIFY(flight.value(mastReleaseSignal) != 0.0);
    QVERIFY(flight.reaches(FlightPhase::ReelOut, 120));
    QCOMPARE(flight.value(mastReleaseSignal), 0.0);
    QVERIFY(flight.reaches(FlightPhase::Descend, 500));
    QVERIFY(flight.reaches(FlightPhase::Docked, 120));
    QVERIFY(flight.isDocked());
    QVERIFY2(flight.value(mastDockingSpeedSignal) <= 1.0, "it docked too fast");
    flight.fly(10);
    const FlightReport report = flight.report();
    QCOMPARE(report.starts, 1);
    QCOMPARE(report.dockings, 1);
    QVERIFY(report.landed && !report.crashed);
    QVERIFY(report.pumpingCycles >= 1);
}

void tst_MastFlight::requestLandsTheKiteInTheMiddleOfReelingOut()
{
    Flight flight(QStringLiteral("mast"));
    QVERIFY2(flight.isReady(), qPrintable(flight.error()));
    QVERIFY(flight.reaches(FlightPhase::ReelOut, 200));
    flight.fly(5 * second);
    QCOMPARE(flight.phase(), FlightPhase::ReelOut);
    QVERIFY(flight.request(FlightRequest::Land));
    flight.fly(3);
    QCOMPARE(flight.phase(), FlightPhase::Descend);
    QVERIFY(flight.reaches(FlightPhase::Docked, 120));
    QVERIFY2(flight.value(mastDockingSpeedSignal) <= 1.0, "it docked too fast");
    flight.fly(120 * second);
    QVERIFY(flight.isDocked());
    QCOMPARE(flight.value(mastDockingsSignal), 1.0);
    QVERIFY(flight.report().landed);
}

void tst_MastFlight::requestToLandKeepsTheKiteAtTheMast()
{
    Flight flight(QStringLiteral("mast"));
    QVERIFY2(flight.isReady(), qPrintable(flight.error()));
    QVERIFY(flight.request(FlightRequest::Land));
    flight.fly(120 * second);
    QVERIFY(flight.isDocked());
    QVERIFY(!flight.request(FlightRequest(3)));
    QVERIFY(flight.request(FlightRequest::Automatic));
    QVERIFY(flight.reaches(FlightPhase::Ascend, 2));
    QCOMPARE(flight.report().dockings, 0);
}

void tst_MastFlight::changingRequestsAreHarmless_data()
{
    QTest::addColumn<int>("begin");   // [cycles]
    QTest::addColumn<int>("period");  // [cycles]
    for (const int begin : {10, 70 * second, 150 * second}) {
        for (const int period : {1, 7, 30, 250})
            QTest::addRow("after %d s, each %d cycles", begin / second, period) << begin << period;
    }
}

/// For a minute an operator cannot decide: at the mast, while the kite ascends, and while it reels
/// out.
void tst_MastFlight::changingRequestsAreHarmless()
{
    QFETCH(int, begin);
    QFETCH(int, period);
    Flight flight(QStringLiteral("mast"));
    QVERIFY2(flight.isReady(), qPrintable(flight.error()));
    flight.fly(begin);
    for (int cycle = 0; cycle < 60 * second; cycle += period) {
        const bool flies = (cycle / period) % 2 == 0;
        QVERIFY(flight.request(flies ? FlightRequest::Fly : FlightRequest::Land));
        flight.fly(period);
    }
    QVERIFY(flight.request(FlightRequest::Land));
    for (int i = 0; i < 120 && !flight.isDocked(); ++i)
        flight.fly(second);
    flight.fly(second);
    QVERIFY(flight.isDocked());
    QVERIFY(!flight.hasCrashed());
    QCOMPARE(flight.phase(), FlightPhase::Docked);
    QVERIFY2(flight.value(mastDockingSpeedSignal) <= 1.0, "it docked too fast");
}

void tst_MastFlight::plantWithoutAMastHasNoRequest()
{
    Flight flight(QStringLiteral("thesis"));
    QVERIFY2(flight.isReady(), qPrintable(flight.error()));
    QVERIFY(!flight.request(FlightRequest::Land));
    QVERIFY2(flight.master().errorString().contains(QLatin1String(flightRequestSignal)),
             qPrintable(flight.master().errorString()));
    flight.fly(10);
    QCOMPARE(flight.phase(), FlightPhase::Launch);
}

/// Whatever he wanted. After that the kite stays on the mast, until a person takes over or releases
/// the request.
void tst_MastFlight::lostOperatorMeansLand()
{
    Flight flight(QStringLiteral("mast"));
    QVERIFY2(flight.isReady(), qPrintable(flight.error()));
    Operator anna;
    QVERIFY(anna.connectTo(flight.master()));
    QVERIFY(anna.takeRequest(FlightRequest::Fly));
    QVERIFY(flight.reaches(FlightPhase::Park, 120));
    QVERIFY2(!flight.request(FlightRequest::Automatic), "the operator holds it");
    anna.vanish();
    QTRY_VERIFY_WITH_TIMEOUT(flight.master().leases().value(0).isLost, patience);
    flight.fly(5);
    QCOMPARE(flight.value(flightRequestSignal), double(FlightRequest::Land));
    QCOMPARE(flight.phase(), FlightPhase::Descend);
    QVERIFY(flight.reaches(FlightPhase::Docked, 120));
    flight.fly(90 * second);
    QVERIFY(flight.isDocked());
    Operator bert;
    QVERIFY(bert.connectTo(flight.master()));
    QVERIFY(bert.takeRequest(FlightRequest::Automatic));
    QVERIFY(flight.reaches(FlightPhase::Ascend, 5));
}

QTEST_GUILESS_MAIN(tst_MastFlight)
#include "tst_MastFlight.moc"
