// SPDX-License-Identifier: Apache-2.0
#include "QPlcApplicationOptions.h"

#include "QPlcMasterNode.h"
#include "realtime/EndSignal.h"
#include "realtime/LogWriter.h"
#include "signals/MemoryNeed.h"
#include "signals/MessageText.h"
#include "transport/FaultPlan.h"

#include <QtCore/QCommandLineParser>
#include <QtCore/QCoreApplication>
#include <QtCore/QSocketNotifier>
#include <QtCore/QTextCodec>
#include <QtCore/QTextStream>

#include <clocale>
#include <csignal>
#include <cstdio>
#include <sys/socket.h>
#include <unistd.h>

namespace {

// What a signal handler writes to: one end of a pair of sockets.
int signalSocket = -1;

void handleSignal(int)
{
    if (void (*const hurry)() = qplc::atEndSignal.load())
        hurry();
    const char byte = 1;
    const ssize_t written = ::write(signalSocket, &byte, 1);
    Q_UNUSED(written)
}

void printLines(const QString &text)
{
    const QByteArray bytes = text.toUtf8();
    std::fwrite(bytes.constData(), 1, std::size_t(bytes.size()), stdout);
    std::fflush(stdout);
}

QString helpText(const QCommandLineParser &parser, const QStringList &examples)
{
    QString text = parser.helpText();
    if (!examples.isEmpty())
        text += QStringLiteral("\nExamples:\n  %1\n").arg(examples.join(QStringLiteral("\n  ")));
    return text;
}

/// "-2" is a number and no option: a blank in front keeps the parser from taking it for one.
QStringList withNumbersHidden(const QStringList &arguments)
{
    QStringList result;
    for (const QString &argument : arguments) {
        const bool isNumber = argument.size() > 1 && argument.at(0) == QLatin1Char('-')
            && (argument.at(1).isDigit() || argument.at(1) == QLatin1Char('.'));
        result << (isNumber ? QLatin1Char(' ') + argument : argument);
    }
    return result;
}

/// What withNumbersHidden() made of it, back again.
QString revealed(const QString &argument)
{
    return argument.startsWith(QLatin1String(" -")) ? argument.mid(1) : argument;
}

QStringList revealed(const QStringList &arguments)
{
    QStringList result;
    for (const QString &argument : arguments)
        result << revealed(argument);
    return result;
}

QString withDashes(const QString &optionName)
{
    return (optionName.size() == 1 ? QStringLiteral("-") : QStringLiteral("--")) + optionName;
}

/// Why the command line cannot be read, in one sentence.
QString wrongUse(const QCommandLineParser &parser, const QStringList &knownNames)
{
    const QString where = QStringLiteral(" (see --help)");
    if (parser.unknownOptionNames().isEmpty()) {
        QString text = parser.errorText();  // "Missing value after '--port'."
        text.replace(0, 1, text.left(1).toLower());
        text.chop(text.endsWith(QLatin1Char('.')) ? 1 : 0);
        return text + where;
    }
    const QString name = parser.unknownOptionNames().constFirst();
    QStringList known;
    for (const QString &candidate : knownNames)
        known << withDashes(candidate);
    constexpr int shortest = 4;  // a shorter one is like too many
    const QStringList close = name.size() < shortest ? QStringList() : qplc::closeNames(withDashes(name), known);
    return QStringLiteral("unknown option %1").arg(qplc::quoted(withDashes(name))) + where + qplc::didYouMean(close);
}

}  // namespace

struct QPlcApplicationOptions::Private
{
    QCommandLineParser parser;
    QStringList optionNames;
    QStringList examples;
    std::function<QString()> helpText;
    bool takesArguments = false;
    int exitCode = Success;
    int sockets[2] = {-1, -1};
    std::unique_ptr<QSocketNotifier> notifier;
};

QPlcApplicationOptions::QPlcApplicationOptions()
    : d(std::make_unique<Private>())
{
    qplc::MemoryNeed::tellAtTheEnd();
    QTextCodec::setCodecForLocale(QTextCodec::codecForName("UTF-8"));
    std::setlocale(LC_NUMERIC, "C");
    if (!qEnvironmentVariableIsSet("QT_MESSAGE_PATTERN"))
        qSetMessagePattern(QStringLiteral("%{appname}: %{if-debug}%{category}: %{endif}%{message}"));
    addOption(QCommandLineOption({QStringLiteral("h"), QStringLiteral("help")}, QStringLiteral("Shows this help.")));
    addOption(QCommandLineOption(QStringLiteral("version"), QStringLiteral("Shows the version.")));
}

QPlcApplicationOptions::~QPlcApplicationOptions()
{
    qplc::LogWriter::releaseMessages();
    d->notifier.reset();
    if (d->sockets[0] < 0)
        return;
    std::signal(SIGINT, SIG_DFL);
    std::signal(SIGTERM, SIG_DFL);
    signalSocket = -1;
    ::close(d->sockets[0]);
    ::close(d->sockets[1]);
}

void QPlcApplicationOptions::setDescription(const QString &text)
{
    d->parser.setApplicationDescription(text);
}

void QPlcApplicationOptions::setExamples(const QStringList &commands)
{
    d->examples = commands;
}

void QPlcApplicationOptions::setHelpText(std::function<QString()> text)
{
    d->helpText = std::move(text);
}

void QPlcApplicationOptions::addOption(const QCommandLineOption &option)
{
    d->parser.addOption(option);
    d->optionNames += option.names();
}

void QPlcApplicationOptions::addPositionalArgument(const QString &name, const QString &description,
                                                   const QString &syntax)
{
    d->takesArguments = true;
    d->parser.addPositionalArgument(name, description, syntax);
}

bool QPlcApplicationOptions::parseOptions()
{
    if (!d->parser.parse(withNumbersHidden(QCoreApplication::arguments()))) {
        d->exitCode = usageError(wrongUse(d->parser, d->optionNames));
        return false;
    }
    if (d->parser.isSet(QStringLiteral("help"))) {
        printLines(d->helpText ? d->helpText() : helpText(d->parser, d->examples));
        return false;
    }
    if (d->parser.isSet(QStringLiteral("version"))) {
        printLines(QStringLiteral("%1 %2\n").arg(QCoreApplication::applicationName(), QStringLiteral(QTPLC_VERSION)));
        return false;
    }
    if (!d->takesArguments && !positionalArguments().isEmpty()) {
        d->exitCode = usageError(QStringLiteral("unexpected argument '%1'; options begin with --, see --help")
                                     .arg(positionalArguments().constFirst()));
        return false;
    }
    return true;
}

int QPlcApplicationOptions::exitCode() const
{
    return d->exitCode;
}

bool QPlcApplicationOptions::isSet(const QString &option) const
{
    return d->parser.isSet(option);
}

QString QPlcApplicationOptions::value(const QString &option) const
{
    return revealed(d->parser.value(option));
}

QStringList QPlcApplicationOptions::values(const QString &option) const
{
    return revealed(d->parser.values(option));
}

QStringList QPlcApplicationOptions::positionalArguments() const
{
    return revealed(d->parser.positionalArguments());
}

bool QPlcApplicationOptions::number(const QString &option, double minimum, double maximum, double *result)
{
    bool isNumber = false;
    const double read = value(option).toDouble(&isNumber);
    if (isNumber && read >= minimum && read <= maximum) {
        *result = read;
        return true;
    }
    d->exitCode = usageError(
        QStringLiteral("--%1 %2: use a number of %3 ... %4").arg(option, value(option)).arg(minimum).arg(maximum));
    return false;
}

bool QPlcApplicationOptions::integer(const QString &option, qint64 minimum, qint64 maximum, qint64 *result)
{
    bool isNumber = false;
    const qint64 read = value(option).toLongLong(&isNumber);
    if (isNumber && read >= minimum && read <= maximum) {
        *result = read;
        return true;
    }
    d->exitCode = usageError(QStringLiteral("--%1 %2: use a whole number of %3 ... %4")
                                 .arg(option, value(option))
                                 .arg(minimum)
                                 .arg(maximum));
    return false;
}

void QPlcApplicationOptions::addRealTimeOptions()
{
    addOption(QCommandLineOption(QStringLiteral("priority"),
                                 QStringLiteral("Runs the cycle under SCHED_FIFO with this priority, 1 ... 99. "
                                                "Default: the scheduling of the program (chrt)."),
                                 QStringLiteral("PRIORITY")));
    addOption(QCommandLineOption(QStringLiteral("cpu"), QStringLiteral("The only processor that the cycle may use."),
                                 QStringLiteral("NUMBER")));
    addOption(QCommandLineOption(QStringLiteral("spin-us"),
                                 QStringLiteral("Time for which the cycle polls for frames before it sleeps, 0 ... "
                                                "10000 [µs]; for a processor that it has to itself."),
                                 QStringLiteral("TIME")));
    addOption(QCommandLineOption(
        QStringLiteral("idle-latency-us"),
        QStringLiteral("Maximum wake-up latency of the processors while cycles run [µs]; 0: they do not sleep."),
        QStringLiteral("TIME")));
    addOption(
        QCommandLineOption(QStringLiteral("lock-memory"), QStringLiteral("Keeps all memory of the program in RAM.")));
}

bool QPlcApplicationOptions::readRealTimeOptions(QPlcRealTimeOptions *options)
{
    qint64 number = 0;
    if (isSet(QStringLiteral("priority"))) {
        if (!integer(QStringLiteral("priority"), 1, 99, &number))
            return false;
        options->policy = QPlcRealTimeOptions::Fifo;
        options->priority = int(number);
    }
    if (isSet(QStringLiteral("cpu"))) {
        if (!integer(QStringLiteral("cpu"), 0, 1023, &number))
            return false;
        options->cpu = int(number);
    }
    if (isSet(QStringLiteral("spin-us"))) {
        if (!integer(QStringLiteral("spin-us"), 0, 10'000, &number))
            return false;
        options->spin = number * 1000;
    }
    if (isSet(QStringLiteral("idle-latency-us"))) {
        if (!integer(QStringLiteral("idle-latency-us"), 0, 1'000'000, &number))
            return false;
        options->idleLatency = int(number);
    }
    options->lockMemory = isSet(QStringLiteral("lock-memory"));
    return true;
}

void QPlcApplicationOptions::addProfileOption()
{
    addOption(QCommandLineOption(
        QStringLiteral("profile"),
        QStringLiteral(
            "How strict the plant is: simulation (late or lost nodes end nothing), plant (they lead to safe "
            "values), or automatic (default): plant with real devices, or with a network and a real-time clock; else "
            "simulation."),
        QStringLiteral("PROFILE"), QStringLiteral("automatic")));
}

bool QPlcApplicationOptions::readProfile(QPlcProfile::Value *profile)
{
    const QString text = value(QStringLiteral("profile"));
    if (QPlcProfile::fromName(text, profile))
        return true;
    usageError(QStringLiteral("--profile '%1': use simulation, plant or automatic").arg(text));
    return false;
}

void QPlcApplicationOptions::addManifestOption()
{
    addOption(QCommandLineOption(
        QStringLiteral("manifest"),
        QStringLiteral("Manifest of the plant: the nodes without which it does not start. Without one, the critical "
                       "nodes that have been there since the start of the master. 'qtplc manifest' writes one."),
        QStringLiteral("FILE")));
}

bool QPlcApplicationOptions::readManifest(QPlcManifest *manifest)
{
    QVector<QPlcParseError> errors;
    if (isSet(QStringLiteral("manifest")))
        *manifest = QPlcManifest::fromIniFile(value(QStringLiteral("manifest")), &errors);
    if (!errors.isEmpty())
        usageError(QPlcParseError::toString(errors));
    return errors.isEmpty();
}

void QPlcApplicationOptions::addEventOption()
{
    addOption(QCommandLineOption(
        QStringLiteral("events"),
        QStringLiteral("File to which the master appends its events, or none. Without it: a file for a master with "
                       "--security or of the profile plant, in /var/log/qtplc or ~/.local/state/qtplc."),
        QStringLiteral("FILE")));
}

void QPlcApplicationOptions::readEventOption(QPlcMasterNode *master) const
{
    const QString file = value(QStringLiteral("events"));
    if (isSet(QStringLiteral("events")))
        master->setEventFile(file == QLatin1String("none") ? QString() : file);
}

void QPlcApplicationOptions::addFaultOptions()
{
    addOption(
        QCommandLineOption(QStringLiteral("enable-fault-injection"), QStringLiteral("Allows --faults, for a test.")));
    addOption(QCommandLineOption(QStringLiteral("faults"),
                                 QStringLiteral("Treats cyclic frames like a bad network, for example "
                                                "loss=5%,delay=2ms,seed=7: loss, duplicate, reorder, corrupt, delay, "
                                                "jitter, cut, each with -sent or -received for one direction; seed."),
                                 QStringLiteral("PLAN")));
}

bool QPlcApplicationOptions::readFaultPlan(QString *plan)
{
    *plan = value(QStringLiteral("faults"));
    QString error;
    if (!isSet(QStringLiteral("faults")) && !isSet(QStringLiteral("enable-fault-injection")))
        return true;
    if (!isSet(QStringLiteral("faults")))
        usageError(QStringLiteral("--enable-fault-injection alone does nothing; name the faults with --faults PLAN"));
    else if (!isSet(QStringLiteral("enable-fault-injection")))
        usageError(QStringLiteral("--faults disturbs the plant on purpose; give --enable-fault-injection, too"));
    else if (!qplc::FaultPlan::fromText(*plan, &error))
        usageError(QStringLiteral("--faults %1").arg(error));
    else
        return true;
    return false;
}

void QPlcApplicationOptions::printError(const QString &text)
{
    qplc::LogWriter &output = qplc::LogWriter::ofStandardError();
    output.write(QtCriticalMsg, QStringLiteral("%1: %2").arg(QCoreApplication::applicationName(), text).toUtf8());
    output.flush(qplc::LogWriter::patience);
}

void QPlcApplicationOptions::startAsynchronousLogging()
{
    qplc::LogWriter::takeMessages();
}

int QPlcApplicationOptions::usageError(const QString &text)
{
    printError(text);
    d->exitCode = UsageError;
    return UsageError;
}

void QPlcApplicationOptions::quitOnSignals(std::function<void()> onSignal)
{
    if (d->sockets[0] >= 0 || ::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, d->sockets) < 0)
        return;
    signalSocket = d->sockets[0];
    d->notifier = std::make_unique<QSocketNotifier>(d->sockets[1], QSocketNotifier::Read);
    QObject::connect(d->notifier.get(), &QSocketNotifier::activated, d->notifier.get(), [this, onSignal] {
        char byte = 0;
        const ssize_t count = ::read(d->sockets[1], &byte, 1);
        Q_UNUSED(count)
        if (onSignal)
            onSignal();
        else
            QCoreApplication::quit();
    });
    struct sigaction action = {};
    action.sa_handler = &handleSignal;
    action.sa_flags = SA_RESTART;
    ::sigaction(SIGINT, &action, nullptr);
    ::sigaction(SIGTERM, &action, nullptr);
}
