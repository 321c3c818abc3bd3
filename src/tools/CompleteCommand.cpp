// SPDX-License-Identifier: Apache-2.0
// complete: how a command line may go on, for the completion of a shell. Never fails and never
// complains: the shell shows what is printed.
#include "Commands.h"
#include "TerminalText.h"

namespace tools {

namespace {

constexpr std::chrono::milliseconds patience{500};  // a person waits for the shell

/// The words of a command line before the one that is completed.
struct Line
{
    const Command *command = nullptr;
    QStringList arguments;       // of the command
    QString master;              // empty: not said
    bool valueIsWanted = false;  // the last word is the value of the option before
};

bool takesValue(const QString &option)
{
    QVector<Option> options = commonOptions();
    for (const Command &command : commands())
        options += command.options;
    for (const Option &other : qAsConst(options)) {
        if (option == QLatin1String("--") + QLatin1String(other.name))
            return *other.value != '\0';
    }
    return false;
}

Line readLine(const QStringList &words)
{
    const QString masterOption = QStringLiteral("--master");
    Line line;
    QString option;  // that waits for its value
    for (const QString &word : words) {
        if (!option.isEmpty()) {
            line.master = option == masterOption ? word : line.master;
            option.clear();
        } else if (word.startsWith(masterOption + QLatin1Char('='))) {
            line.master = word.mid(masterOption.size() + 1);
        } else if (word.startsWith(QLatin1String("--"))) {
            option = takesValue(word) ? word : QString();
        } else if (!line.command) {
            line.command = findCommand(word);
        } else {
            line.arguments << word;
        }
    }
    line.valueIsWanted = !option.isEmpty();
    return line;
}

QStringList optionsOf(const Command *command)
{
    QVector<Option> options = command ? command->options : QVector<Option>();
    options += commonOptions();
    QStringList names;
    for (const Option &option : qAsConst(options))
        names << QLatin1String("--") + QLatin1String(option.name);
    return names << QStringLiteral("--help");
}

QStringList namesOfCommands()
{
    QStringList names;
    for (const Command &command : commands())
        names << QString::fromLatin1(command.name);
    return names;
}

/// Names of the signals of the live master; none when there is no master. \param onlyFree those
/// without a writer
QStringList signalNames(const QString &address, bool onlyFree)
{
    const QPlcUnderlyingProtocol master = QPlcUnderlyingProtocol::fromString(address);
    BlockingClient client(patience);
    if (!master.isValid() || !client.connectToMaster(master))
        return {};
    QStringList names;
    const QPlcSignalTable table = client.table();
    for (const QPlcSignalDefinition &definition : table)
        names << definition.name;
    std::vector<qplc::messages::SignalEntry> signals;
    if (!onlyFree || !client.askForSignals(names, &signals))
        return names;
    names.clear();
    for (const qplc::messages::SignalEntry &signal : signals) {
        if (signal.writer.isEmpty())
            names << signal.name;
    }
    return names;
}

QStringList candidates(const Line &line, const QString &word, const QString &master)
{
    if (line.valueIsWanted)
        return {};
    if (word.startsWith(QLatin1Char('-')))
        return optionsOf(line.command);
    if (!line.command)
        return namesOfCommands();
    switch (line.command->arguments) {
    case Command::NoArguments:
        return {};
    case Command::CommandNames:
        return line.arguments.isEmpty() ? namesOfCommands() : QStringList();
    case Command::Signals:
        return signalNames(master, false);
    case Command::SignalsAndValues:
        return line.arguments.size() % 2 == 0 ? signalNames(master, true) : QStringList();
    }
    return {};
}

}  // namespace

int completeWord(const CommandCall &call)
{
    const QStringList words = call.arguments.mid(1);  // the first one is the name of the program
    const QString word = words.isEmpty() ? QString() : words.constLast();
    const Line line = readLine(words.mid(0, words.size() - 1));
    const QString master = line.master.isEmpty() ? placeText(call.master) : line.master;
    const QStringList all = candidates(line, word, master);
    for (const QString &candidate : all) {
        if (candidate.startsWith(word))
            printLine(printable(candidate));
    }
    return QPlcCoreApplication::Success;
}

}  // namespace tools
