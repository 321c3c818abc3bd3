// SPDX-License-Identifier: Apache-2.0
#include "../common/Waiting.h"
#include "VirtualTime.h"
#include "node/session/ViewerPushes.h"
#include "protocol/ControlFrame.h"
#include "transport/ControlNetwork.h"

using namespace qplc;
using namespace std::chrono_literals;

// What viewers are told without asking, and what becomes of it when one of them takes nothing in.
class tst_ViewerPushes : public QObject
{
    Q_OBJECT

private Q_SLOTS:
    void stoppedViewerCostsNoMemoryAndSeesTheGap();
    void viewerWithoutTheFeatureGetsNoPushes();
};

namespace {

const QPlcSignalTable &table()
{
    static const QPlcSignalTable signalTable = QPlcSignalTable::fromIni("[s]\ntype = Int32\n");
    return signalTable;
}

/// A master without cycles.
struct Master
{
    NodeRegistry registry{table()};
    ProcessImage image{table()};
    CyclicHub hub;
    Evictions evictions;
    MasterServer server{registry,
                        image,
                        hub,
                        5,
                        [] { return messages::MasterHello(); },
                        [](NodeDeclaration *, const MasterConnection &, const QString &) { return Refusal(); },
                        evictions,
                        nullptr};
    EventLog events;
    int pictures = 0;
    ViewerPushes pushes{server, events, [this] {
                            ++pictures;
                            return messages::LeasesChanged();
                        }};

    void happens(const QString &text)
    {
        events.append({JournalEvent::Info, JournalEvent::Node, QStringLiteral("Winch"), text}, 0);
        pushes.eventsHappened();
    }
    qint64 waiting() const { return server.connections().front()->socket->bytesToSend(); }
};

/// A viewer that reads when the test says so, and not when bytes come.
class Viewer
{
public:
    bool greet(quint16 port, const QJsonArray &features)
    {
        QObject::connect(m_socket.get(), &QTcpSocket::connected, m_socket.get(), [this, features] {
            m_socket->write(encodeControlFrame(
                QPlcMessage(QPlcMessage::Hello, {{"protocol", 2}, {"name", "Viewer"}, {"features", features}})));
        });
        m_socket->connectToHost(QHostAddress(QHostAddress::LocalHost), port);
        return waitUntil([this] { return next().kind() == QPlcMessage::Hello; });
    }
    /// The next message that is there; of kind Invalid when there is none.
    QPlcMessage next()
    {
        m_reader.append(m_socket->readAll());
        QPlcMessage message;
        m_reader.next(&message);
        return message;
    }

private:
    std::unique_ptr<QTcpSocket> m_socket{ControlNetwork::current().makeSocket(nullptr)};
    ControlFrameReader m_reader;
};

}  // namespace

void tst_ViewerPushes::stoppedViewerCostsNoMemoryAndSeesTheGap()
{
    Master master;
    QVERIFY(master.server.listen(QHostAddress::LocalHost, 0, {}, {}));
    Viewer viewer;
    QVERIFY(viewer.greet(master.server.port(), {"leases", "events"}));
    const QString longText(EventLog::LongestText, 'x');
    qint64 most = 0;
    for (int round = 0; most < 64 * 1024 && round < 1000; ++round) {
        for (int i = 0; i < 500; ++i)
            master.happens(longText);
        pass(5ms);
        most = std::max(most, master.waiting());
    }
    QVERIFY2(most >= 64 * 1024, "the kernel took everything: nothing is shown");
    for (int i = 0; i < 50; ++i) {
        for (int j = 0; j < 100; ++j)
            master.happens(longText);
        master.pushes.leasesChanged();
        pass(10ms);
        most = std::max(most, master.waiting());
    }
    QVERIFY2(most < 256 * 1024, qPrintable(QString::number(most)));
    // It goes on: what is too old is gone, and the numbers show it.
    quint64 sequence = 0;
    quint64 widestGap = 0;
    int pictures = 0;
    QVERIFY(waitUntil([&] {
        for (QPlcMessage message; (message = viewer.next()).kind() != QPlcMessage::Invalid;) {
            pictures += message.kind() == QPlcMessage::LeasesChanged;
            for (const QJsonValue event : message.fields().value("events").toArray()) {
                const auto next = quint64(event["sequence"].toDouble());
                widestGap = std::max(widestGap, next - sequence);
                sequence = next;
            }
        }
        return sequence == master.events.newest();
    }));
    QVERIFY(widestGap > 1);
    QVERIFY2(pictures >= 1 && pictures < 5, qPrintable(QString::number(pictures)));
}

void tst_ViewerPushes::viewerWithoutTheFeatureGetsNoPushes()
{
    Master master;
    QVERIFY(master.server.listen(QHostAddress::LocalHost, 0, {}, {}));
    Viewer plain, leasesOnly;
    QVERIFY(plain.greet(master.server.port(), {}));
    QVERIFY(leasesOnly.greet(master.server.port(), {"leases"}));
    master.happens("something");
    master.pushes.leasesChanged();
    QVERIFY(waitUntil([&] { return leasesOnly.next().kind() == QPlcMessage::LeasesChanged; }, 5000));
    pass(50ms);
    QCOMPARE(leasesOnly.next().kind(), QPlcMessage::Invalid);
    QCOMPARE(plain.next().kind(), QPlcMessage::Invalid);
}

QTPLC_VIRTUAL_TIME_MAIN(tst_ViewerPushes)
#include "tst_ViewerPushes.moc"
