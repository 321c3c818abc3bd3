// SPDX-License-Identifier: Apache-2.0
#include "DemoPlant.h"

#include <QtCore/QElapsedTimer>
#include <QtCore/QFileInfo>
#include <QtCore/QRegularExpression>
#include <QtPlcCore>

#include <algorithm>
#include <cstring>

namespace awe {

namespace {

constexpr int Patience = 2000;         // [ms] for a program that is asked to end
constexpr int Followers = 200;         // [ms] in which others end for the same reason
constexpr int KeptErrors = 64 * 1024;  // [bytes] of what a program says

const QString masterName = QStringLiteral("awe_master");
const QString modelName = QStringLiteral("awe_model");
const QString autopilotName = QStringLiteral("awe_autopilot");

const QString portOption = QStringLiteral("--port=");

/// As one word of a shell.
QString quoted(QString word)
{
    static const QRegularExpression plain(QStringLiteral("^[\\w@%+=:,./-]+$"));
    if (plain.match(word).hasMatch())
        return word;
    return QLatin1Char('\'') + word.replace(QLatin1Char('\''), QLatin1String("'\\''")) + QLatin1Char('\'');
}

/// "exit code 1", "Killed".
QString wayOfEnding(const QProcess &process)
{
    if (process.error() == QProcess::FailedToStart)
        return process.errorString();
    return process.exitStatus() == QProcess::CrashExit ? QString::fromLocal8Bit(::strsignal(process.exitCode()))
                                                       : DemoPlant::tr("exit code %1").arg(process.exitCode());
}

}  // namespace

struct DemoPlant::Program
{
    QString name;
    ChildProcess process;
    QByteArray errors;  // the newest of them

    void read()
    {
        errors = (errors + process.readAllStandardError()).right(KeptErrors);
        if (name != masterName)
            process.readAllStandardOutput();
    }
    /// The last line that it has written on its standard error, without its own name in front.
    QString lastWords() const
    {
        const QString line = QString::fromUtf8(errors).trimmed().section(QLatin1Char('\n'), -1).trimmed();
        const QString prefix = name + QStringLiteral(": ");
        return line.startsWith(prefix) ? line.mid(prefix.size()) : line;
    }
};

DemoPlant::DemoPlant(const QString &folder, QObject *parent)
    : QObject(parent)
    , m_folder(folder.isEmpty() ? QCoreApplication::applicationDirPath() : folder)
{
    m_patience.setSingleShot(true);
    m_telling.setSingleShot(true);
    connect(&m_telling, &QTimer::timeout, this, [this] { Q_EMIT failed(m_sentence); });
    connect(&m_patience, &QTimer::timeout, this, [this] {
        for (const std::unique_ptr<Program> &program : m_programs)
            program->process.kill();
    });
}

DemoPlant::~DemoPlant()
{
    terminate();
    QElapsedTimer clock;
    clock.start();
    for (const std::unique_ptr<Program> &program : m_programs) {
        program->process.disconnect(this);
        if (program->process.state() == QProcess::NotRunning
            || program->process.waitForFinished(std::max(0, Patience - int(clock.elapsed()))))
            continue;
        program->process.kill();
        program->process.waitForFinished(Patience);
    }
}

QString DemoPlant::address() const
{
    return m_isListening ? QStringLiteral("127.0.0.1:%1").arg(m_port) : QString();
}

QString DemoPlant::commands() const
{
    if (!isRunning())
        return {};
    QString text = QStringLiteral("cd ") + quoted(m_folder.absolutePath());
    for (const std::unique_ptr<Program> &program : m_programs) {
        text += QStringLiteral("\n./") + program->name;
        for (const QString &argument : program->process.arguments())
            text += QLatin1Char(' ')
                + quoted(argument.startsWith(portOption) ? portOption + QString::number(m_port) : argument);
        text += QStringLiteral(" &");
    }
    return text;
}

void DemoPlant::start()
{
    if (m_hasFailed || (isRunning() && m_plant != m_flownPlant))
        restart();
    else if (m_isListening)
        Q_EMIT listening(address());
    else if (!isRunning() && areAllThere())
        startMaster();
}

void DemoPlant::restart()
{
    m_hasFailed = false;
    m_telling.stop();
    if (!isRunning()) {
        start();
        return;
    }
    m_isRestarting = true;
    m_isListening = false;
    terminate();
    m_patience.start(Patience);
}

/// \return false, with failed() out, when a program is not beside this one
bool DemoPlant::areAllThere()
{
    for (const QString &name : {masterName, modelName, autopilotName}) {
        const QFileInfo file(m_folder, name);
        if (file.isFile() && file.isExecutable())
            continue;
        Q_EMIT failed(tr("The demo needs %1, which is not beside this program in %2. Build it there "
                         "(cmake --build build/release --target programs), or install all programs again.")
                          .arg(name, m_folder.path()));
        return false;
    }
    return true;
}

void DemoPlant::run(const QString &name, const QStringList &arguments)
{
    m_programs.push_back(std::make_unique<Program>());
    Program *program = m_programs.back().get();
    program->name = name;
    connect(&program->process, &QProcess::readyReadStandardError, this, [program] { program->read(); });
    connect(&program->process, &QProcess::readyReadStandardOutput, this, [this, program] {
        if (program->name == masterName)
            readMaster(program);
        else
            program->read();
    });
    connect(&program->process, &QProcess::stateChanged, this, [this, program](QProcess::ProcessState state) {
        if (state == QProcess::NotRunning)  // and goes, but not from within its own signal
            QMetaObject::invokeMethod(
                this, [this, program] { ended(program); }, Qt::QueuedConnection);
    });
    program->process.start(m_folder.filePath(name), arguments);
}

void DemoPlant::startMaster()
{
    m_isRestarting = false;
    m_hasFailed = false;
    m_flownPlant = m_plant;
    run(masterName,
        QStringList{QStringLiteral("--real-time"), QStringLiteral("--stay"), portOption + QString::number(m_port),
                    QStringLiteral("--start-with=Model,Autopilot")}
            + plantOption());
}

QStringList DemoPlant::plantOption() const
{
    return m_flownPlant.isEmpty() ? QStringList() : QStringList{QStringLiteral("--plant=") + m_flownPlant};
}

/// The master says where it listens, then nodes can come.
void DemoPlant::readMaster(Program *master)
{
    while (master->process.canReadLine()) {
        const std::optional<quint16> port = portOfMaster(master->process.readLine());
        if (!port || m_isListening || m_isRestarting)
            continue;
        m_port = *port;
        m_isListening = true;
        startNodes();
        Q_EMIT listening(address());
    }
}

void DemoPlant::startNodes()
{
    const QString master = QStringLiteral("--master=udp://%1").arg(address());
    run(modelName, QStringList{master, QStringLiteral("--turbulence=0.1")} + plantOption());
    run(autopilotName, QStringList{master} + plantOption());
}

void DemoPlant::ended(Program *program)
{
    program->read();
    const bool isMaster = program->name == masterName;
    const bool neverListened = isMaster && !m_isListening && m_port != 0;
    if (isMaster)
        m_isListening = false;
    if (!m_isRestarting && !neverListened)
        blame(*program);
    m_programs.erase(std::find_if(m_programs.begin(), m_programs.end(),
                                  [program](const std::unique_ptr<Program> &each) { return each.get() == program; }));
    if (m_isRestarting && !isRunning()) {
        m_patience.stop();
        startMaster();
    } else if (neverListened && !m_isRestarting) {
        m_port = 0;  // somebody else has taken it meanwhile
        startMaster();
    }
}

/// One that ends takes others with it: what crashed is the cause, else the master, else the first.
void DemoPlant::blame(const Program &program)
{
    const int suspicion
        = (program.process.exitStatus() == QProcess::CrashExit ? 2 : 0) + (program.name == masterName ? 1 : 0);
    if (!m_hasFailed)
        m_telling.start(Followers);
    else if (!m_telling.isActive() || suspicion <= m_suspicion)
        return;
    m_hasFailed = true;
    m_suspicion = suspicion;
    m_sentence = tr("%1 has ended (%2)").arg(program.name, wayOfEnding(program.process));
    const QString words = program.lastWords();
    const bool hasCrashed = program.process.exitStatus() == QProcess::CrashExit;  // then words need not be of its end
    if (!words.isEmpty())
        m_sentence += (hasCrashed ? tr(". It said last: %1") : tr(": %1")).arg(words);
}

void DemoPlant::terminate()
{
    for (const std::unique_ptr<Program> &program : m_programs)
        program->process.terminate();
}

}  // namespace awe
