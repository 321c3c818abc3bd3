// SPDX-License-Identifier: Apache-2.0
#include "../common/Waiting.h"
#include "node/session/ViewerPushes.h"
#include "protocol/ControlFrame.h"

#include <sys/socket.h>
#include <unistd.h>

using namespace qplc;

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
    MasterServer server{registry,
                        image,
                        hub,
                        5,
                        [] { return messages::MasterHello(); },
                        [](const NodeDeclaration &) { return Refusal(); },
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
    ~Viewer() { ::close(m_descriptor); }
    bool greet(quint16 port, const QJsonArray &features)
    {
        const SocketAddress address(QHostAddress(QHostAddress::LocalHost), port);
        m_descriptor = ::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
        const int small = 8192;  // so that a viewer that does not read is noticed soon
        ::setsockopt(m_descriptor, SOL_SOCKET, SO_RCVBUF, &small, sizeof small);
        const QByteArray hello = encodeControlFrame(
            QPlcMessage(QPlcMessage::Hello, {{"protocol", 1}, {"name", "Viewer"}, {"features", features}}));
        return ::connect(m_descriptor, address.data(), address.length) == 0
            && ::send(m_descriptor, hello.constData(), std::size_t(hello.size()), MSG_NOSIGNAL) == hello.size()
            && waitUntil([this] { return next().kind() == QPlcMessage::Hello; }, 5000);
    }
    /// The next message that is there; of kind Invalid when there is none.
    QPlcMessage next()
    {
        QByteArray bytes(65536, '\0');
        const ssize_t size = ::recv(m_descriptor, bytes.data(), std::size_t(bytes.size()), MSG_DONTWAIT);
        m_reader.append(bytes.left(int(std::max<ssize_t>(size, 0))));
        QPlcMessage message;
        m_reader.next(&message);
        return message;
    }

private:
    int m_descriptor = -1;
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
    QElapsedTimer clock;
    clock.start();
    while (most < 64 * 1024 && clock.elapsed() < 30000) {
        for (int i = 0; i < 500; ++i)
            master.happens(longText);
        QTest::qWait(5);
        most = std::max(most, master.waiting());
    }
    QVERIFY2(most >= 64 * 1024, "the kernel took everything: nothing is shown");
    for (int i = 0; i < 50; ++i) {
        for (int j = 0; j < 100; ++j)
            master.happens(longText);
        master.pushes.leasesChanged();
        QTest::qWait(10);
        most = std::max(most, master.waiting());
    }
    QVERIFY2(most < 256 * 1024, qPrintable(QString::number(most)));
    // It goes on: what is too old is gone, and the numbers show it.
    quint64 sequence = 0;
    quint64 widestGap = 0;
    int pictures = 0;
    QVERIFY(waitUntil(
        [&] {
            for (QPlcMessage message; (message = viewer.next()).kind() != QPlcMessage::Invalid;) {
                pictures += message.kind() == QPlcMessage::LeasesChanged;
                for (const QJsonValue event : message.fields().value("events").toArray()) {
                    const auto next = quint64(event["sequence"].toDouble());
                    widestGap = std::max(widestGap, next - sequence);
                    sequence = next;
                }
            }
            return sequence == master.events.newest();
        },
        20000));
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
    QTest::qWait(50);
    QCOMPARE(leasesOnly.next().kind(), QPlcMessage::Invalid);
    QCOMPARE(plain.next().kind(), QPlcMessage::Invalid);
}

QTEST_GUILESS_MAIN(tst_ViewerPushes)
#include "tst_ViewerPushes.moc"
