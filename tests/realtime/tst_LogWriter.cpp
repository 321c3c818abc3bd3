// SPDX-License-Identifier: Apache-2.0
#include "realtime/LogWriter.h"

#include <QtTest/QtTest>

#include <array>
#include <sys/stat.h>
#include <thread>
#include <unistd.h>

using qplc::LogWriter;

namespace {

/// A pipe; nobody reads it but by read().
class Pipe
{
public:
    Pipe() { m_isOpen = ::pipe(m_ends.data()) == 0; }
    ~Pipe()
    {
        ::close(m_ends[0]);
        ::close(m_ends[1]);
    }
    Pipe(const Pipe &) = delete;
    Pipe &operator=(const Pipe &) = delete;

    bool isOpen() const { return m_isOpen; }
    int input() const { return m_ends[1]; }
    /// The next line with its end.
    QByteArray readLine()
    {
        while (!m_bytes.contains('\n')) {
            std::array<char, 65536> read;
            const ssize_t size = ::read(m_ends[0], read.data(), read.size());
            if (size <= 0)
                return m_bytes;
            m_bytes += QByteArray(read.data(), int(size));
        }
        const QByteArray line = m_bytes.left(m_bytes.indexOf('\n') + 1);
        m_bytes.remove(0, line.size());
        return line;
    }

private:
    std::array<int, 2> m_ends = {-1, -1};
    bool m_isOpen = false;
    QByteArray m_bytes;
};

QByteArray lineOf(int number)
{
    return QByteArray::number(number).rightJustified(99, '.') + '\n';
}

/// "... 17 lines are missing here: ..."; 0 for any other line.
int missingIn(const QByteArray &line)
{
    return line.startsWith("... ") ? line.mid(4).split(' ').constFirst().toInt() : 0;
}

}  // namespace

class tst_LogWriter : public QObject
{
    Q_OBJECT

private Q_SLOTS:
    void init();
    void linesArriveInTheirOrder();
    void readerThatStandsStillStopsNobody();
    void missingLinesAreCountedWhereTheyAreMissing();
    void everyLineOfTheJournalHasItsSeverity();
    void otherOutputHasNoSeverity();
    void lineThatIsLongerThanTheRoomArrives();
    void writerEndsWhileItsReaderStandsStill();
    void closedDescriptorLosesLinesOnly();

private:
    std::unique_ptr<Pipe> m_pipe;
};

void tst_LogWriter::init()
{
    m_pipe = std::make_unique<Pipe>();
    QVERIFY(m_pipe->isOpen());
}

void tst_LogWriter::linesArriveInTheirOrder()
{
    LogWriter writer(m_pipe->input());
    for (int i = 0; i < 500; ++i)
        writer.write(lineOf(i));
    QVERIFY(writer.flush(10000));
    for (int i = 0; i < 500; ++i)
        QCOMPARE(m_pipe->readLine(), lineOf(i));
    QCOMPARE(writer.dropped(), quint64(0));
}

// Without a thread of its own this test never ends: a pipe takes 64 KiB.
void tst_LogWriter::readerThatStandsStillStopsNobody()
{
    LogWriter writer(m_pipe->input());
    constexpr int lines = 100'000;
    for (int i = 0; i < lines; ++i)
        writer.write(lineOf(i));
    QVERIFY(!writer.flush(0));
    const int kept = lines - int(writer.dropped());
    QVERIFY2(kept >= LogWriter::mostBytes / 100 && kept <= (LogWriter::mostBytes + 65536) / 100 + 1,
             qPrintable(QString::number(kept)));
    std::thread reader([&] {
        while (missingIn(m_pipe->readLine()) == 0) {}
    });
    const bool isAllRead = writer.flush(60000);
    reader.join();
    QVERIFY(isAllRead);
}

void tst_LogWriter::missingLinesAreCountedWhereTheyAreMissing()
{
    LogWriter writer(m_pipe->input());
    constexpr int lines = 100'000;
    for (int i = 0; i < lines / 2; ++i)
        writer.write(lineOf(i));
    QVERIFY(writer.dropped() > 0);
    int number = 0;
    int notices = 0;
    std::thread reader([&] {
        while (number < lines) {
            const QByteArray line = m_pipe->readLine();
            const int missing = missingIn(line);
            if (missing == 0 && line != lineOf(number))
                break;
            number += missing == 0 ? 1 : missing;
            notices += missing == 0 ? 0 : 1;
        }
    });
    for (int i = lines / 2; i < lines; ++i)
        writer.write(lineOf(i));
    const bool isAllRead = writer.flush(60000);
    reader.join();
    QVERIFY(isAllRead);
    QCOMPARE(number, lines);  // each was read or counted
    QVERIFY(notices >= 1);
}

void tst_LogWriter::everyLineOfTheJournalHasItsSeverity()
{
    struct stat status = {};
    QCOMPARE(::fstat(m_pipe->input(), &status), 0);
    qputenv("JOURNAL_STREAM", QStringLiteral("%1:%2").arg(status.st_dev).arg(status.st_ino).toLatin1());
    LogWriter writer(m_pipe->input());
    qunsetenv("JOURNAL_STREAM");
    writer.write(QtWarningMsg, "first\nsecond");
    writer.write(QtCriticalMsg, "third");
    for (const char *line : {"<4>first\n", "<4>second\n", "<2>third\n"})
        QCOMPARE(m_pipe->readLine(), QByteArray(line));
    for (int i = 0; i < 50'000; ++i)
        writer.write(lineOf(i));
    QByteArray line;
    std::thread reader([&] {
        do
            line = m_pipe->readLine();
        while (!line.contains("missing"));
    });
    const bool isAllRead = writer.flush(60000);
    reader.join();
    QVERIFY(isAllRead);
    QVERIFY2(line.startsWith("<4>... "), line.constData());
}

void tst_LogWriter::otherOutputHasNoSeverity()
{
    LogWriter writer(m_pipe->input());
    writer.write(QtWarningMsg, "first\nsecond");
    QCOMPARE(m_pipe->readLine(), QByteArray("first\n"));
    QCOMPARE(m_pipe->readLine(), QByteArray("second\n"));
}

void tst_LogWriter::lineThatIsLongerThanTheRoomArrives()
{
    LogWriter writer(m_pipe->input());
    const QByteArray line = QByteArray(2 * LogWriter::mostBytes, 'x') + '\n';
    writer.write(line);
    QCOMPARE(m_pipe->readLine(), line);
}

void tst_LogWriter::writerEndsWhileItsReaderStandsStill()
{
    auto writer = std::make_unique<LogWriter>(m_pipe->input());
    for (int i = 0; i < 10'000; ++i)
        writer->write(lineOf(i));
    writer.reset();  // does not wait for ever
    QCOMPARE(m_pipe->readLine(), lineOf(0));
    while (m_pipe->readLine() != lineOf(9'999)) {}  // its thread ends here
}

void tst_LogWriter::closedDescriptorLosesLinesOnly()
{
    LogWriter writer(-1);
    writer.write("lost\n");
    QVERIFY(writer.flush(10000));
}

QTEST_APPLESS_MAIN(tst_LogWriter)
#include "tst_LogWriter.moc"
