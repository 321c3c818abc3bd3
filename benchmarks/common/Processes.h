// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <QtPlcCore>

#include <QtCore/QFile>
#include <QtCore/QJsonObject>
#include <QtCore/QProcess>
#include <QtCore/QRandomGenerator>
#include <QtCore/QTemporaryDir>
#include <QtCore/QTimer>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <memory>
#include <sys/prctl.h>
#include <utility>
#include <vector>

// What benchmarks with several processes share: a program that starts itself in other roles, whose
// lines it reads.

/// All processes of a computer see this clock [ns].
inline qint64 now()
{
    return std::chrono::nanoseconds(std::chrono::steady_clock::now().time_since_epoch()).count();
}

inline void tell(const QString &line)
{
    std::fprintf(stdout, "%s\n", qPrintable(line));
    std::fflush(stdout);
}

/// A tool that has greeted its master.
class Tool
{
public:
    Tool(const QString &name, const QString &keys, const QPlcUnderlyingProtocol &master)
    {
        m_socket.setSecurity(QPlcSecurity::preSharedKeys(keys, name));
        QObject::connect(&m_socket, &QPlcAbstractSocket::connected, &m_socket, [this, name] {
            m_socket.setMessageLimit(longestMessage);
            m_socket.setSendLimit(longestMessage);
            send(QPlcMessage::Hello, {{"protocol", 2}, {"name", name}, {"role", "tool"}});
        });
        QObject::connect(&m_socket, &QPlcAbstractSocket::messageReceived, &m_socket,
                         [this](const QPlcMessage &message) {
                             if (onMessage)
                                 onMessage(message);
                         });
        QObject::connect(&m_socket, &QPlcAbstractSocket::errorOccurred, &m_socket, [this] {
            std::fprintf(stderr, "%s\n", qPrintable(m_socket.errorString()));
            std::exit(1);
        });
        m_socket.connectToMaster(master);
    }
    void send(QPlcMessage::Kind kind, const QJsonObject &fields = {})
    {
        m_socket.sendMessage(QPlcMessage(kind, fields));
    }
    std::function<void(const QPlcMessage &)> onMessage;

private:
    static constexpr quint32 longestMessage = 64 << 20;  // [byte]

    QPlcMasterSocket m_socket;
};

/// This program in another role.
class Child : public QProcess
{
public:
    explicit Child(const QStringList &arguments)
    {
        setProcessChannelMode(QProcess::ForwardedErrorChannel);
        start(QCoreApplication::applicationFilePath(), arguments);
    }
    ~Child() override
    {
        kill();
        waitForFinished();
    }
    /// It does not outlive a measurement that has failed.
    void setupChildProcess() override { ::prctl(PR_SET_PDEATHSIG, SIGKILL); }
    /// The words behind \a word of the next line that begins with it.
    QStringList next(const QString &word)
    {
        while (true) {
            while (canReadLine()) {
                const QStringList words = QString::fromUtf8(readLine()).trimmed().split(' ');
                if (words.first() == word)
                    return words.mid(1);
            }
            if (state() == NotRunning)
                qFatal("a process has ended");
            QCoreApplication::processEvents(QEventLoop::WaitForMoreEvents);
        }
    }
};

inline double percentile(std::vector<double> values, double share)
{
    std::sort(values.begin(), values.end());
    return values.empty() ? 0.0 : values[std::min(values.size() - 1, std::size_t(share * double(values.size())))];
}

inline void show(const char *what, const std::vector<double> &values, const char *unit)
{
    tell(QStringLiteral("%1: n %2, p50 %3, p99 %4, p99.9 %5, longest %6 %7")
             .arg(QLatin1String(what))
             .arg(values.size())
             .arg(percentile(values, 0.5), 0, 'f', 2)
             .arg(percentile(values, 0.99), 0, 'f', 2)
             .arg(percentile(values, 0.999), 0, 'f', 2)
             .arg(percentile(values, 1.0), 0, 'f', 2)
             .arg(QLatin1String(unit)));
}

inline void pass(int milliseconds)
{
    QEventLoop loop;
    QTimer::singleShot(milliseconds, Qt::PreciseTimer, &loop, &QEventLoop::quit);
    loop.exec();
}

/// A file with a new key for each identity, which has a role.
inline QString makeKeys(const QTemporaryDir &folder,
                        const std::vector<std::pair<const char *, const char *>> &identities)
{
    QFile file(folder.filePath(QStringLiteral("keys.ini")));
    if (!file.open(QIODevice::WriteOnly))
        qFatal("cannot write %s", qPrintable(file.fileName()));
    file.setPermissions(QFile::ReadOwner | QFile::WriteOwner);
    for (const auto &[identity, role] : identities) {
        file.write("[" + QByteArray(identity) + "]\nkey = ");
        for (int i = 0; i < 4; ++i)
            file.write(QByteArray::number(QRandomGenerator::system()->generate64(), 16).rightJustified(16, '0'));
        file.write(QByteArray("\nrole = ") + role + '\n');
    }
    return file.fileName();
}
