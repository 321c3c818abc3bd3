// SPDX-License-Identifier: Apache-2.0
#include "Commands.h"

#include "TerminalText.h"
#include "signals/MessageText.h"

#include <limits>

namespace tools {

namespace {

constexpr int any = std::numeric_limits<int>::max();

const Option verbose{"verbose", "", "Every column and counter."};
const Option count{"count", "N", "Ends after N lines."};
const Option every{"every", "CYCLES", "Hears one cycle of CYCLES only, for slow links."};
const Option output{"output", "FILE", "Written file, - for standard output; or -o FILE.", "o"};
const Option force{"force", "", "Replaces a file that is there."};
const Option from{"from", "TIME", "Leaves out the cycles before."};
const Option upTo{"to", "TIME", "Leaves out the cycles behind."};

}  // namespace

const QVector<Command> &commands()
{
    static const QVector<Command> table{
        {"list",
         "[SIGNAL|PATTERN...]",
         "Shows signals: type, unit, value and who writes them.",
         "All of them unless names or patterns are given. A pattern has *, ? or [...];\n"
         "put it in quotes.",
         {verbose},
         {QStringLiteral("qtplc list"), QStringLiteral("qtplc list 'tether*' --verbose"),
          QStringLiteral("qtplc list --json | jq -r '.[] | select(.writer == \"\").name'")},
         Command::Signals,
         0,
         any,
         &listSignals},
        {"get",
         "SIGNAL|PATTERN...",
         "Prints values once.",
         "A line for each signal. For scripts: --plain prints the value only, --json one\n"
         "object, name to value.",
         {{"plain", "", "The value only, without name and unit."}},
         {QStringLiteral("qtplc get tetherLength power"), QStringLiteral("speed=$(qtplc get tetherSpeed --plain)"),
          QStringLiteral("qtplc get '*' --json | jq .power")},
         Command::Signals,
         1,
         any,
         &getSignals},
        {"set",
         "SIGNAL VALUE ...",
         "Sets signals that no node writes: all or none.",
         "With --for the master brings the former values back after that time, and at once\n"
         "when this program is interrupted, killed or cut off.",
         {{"for", "SECONDS", "Sets the values for this time only."}},
         {QStringLiteral("qtplc set tetherSpeed -1.5"), QStringLiteral("qtplc set windVelocity_earth 5,-3,0"),
          QStringLiteral("qtplc set tetherSpeed 2 bodyControlYawSpeed 30 --for 1.5")},
         Command::SignalsAndValues,
         2,
         any,
         &setSignals},
        {"echo",
         "SIGNAL|PATTERN...",
         "Prints values as they come, until Ctrl-C.",
         "Aligned columns on a terminal, separated by tabs elsewhere. While no cycle runs,\n"
         "the present values are printed once. --json prints an object for each line.",
         {{"rate", "HZ", "Most lines per second, default 10."}, every, count},
         {QStringLiteral("qtplc echo tetherLength power --rate 2"),
          QStringLiteral("qtplc echo power --json --rate 1000 > power.jsonl")},
         Command::Signals,
         1,
         any,
         &echoSignals},
        {"watch",
         "[SIGNAL|PATTERN...]",
         "Shows values, extremes and age on the whole terminal.",
         "All signals unless names or patterns are given; a line for each element of an\n"
         "array. Every cycle that is heard counts for the extremes, with --every not all.\n"
         "Age is the time since the value changed. Keys: q ends, arrows and page keys\n"
         "scroll, r forgets the extremes. Where the output is no terminal, watch is echo.",
         {{"rate", "HZ", "Pictures (or lines) per second, default 10."}, every},
         {QStringLiteral("qtplc watch 'tether*' power"), QStringLiteral("qtplc watch")},
         Command::Signals,
         0,
         any,
         &watchSignals},
        {"hz",
         "",
         "Measures the rate of the cycle as a listener hears it.",
         "Cycles heard, rate, the intervals between them and their scatter, and which\n"
         "cycles were lost (of those, how many the master itself skipped). The exit code\n"
         "is 1 when cycles were lost.",
         {{"for", "SECONDS", "Measures for this time, default 3."}},
         {QStringLiteral("qtplc hz"), QStringLiteral("qtplc hz --for 60 --json")},
         Command::NoArguments,
         0,
         0,
         &measureRate},
        {"state",
         "",
         "Shows the master, its counters and its nodes.",
         "With the state of each node, and why the master is in Safe stop or Fault.\n"
         "Counters that are zero are shown with --verbose only; --json has all of them.",
         {verbose},
         {QStringLiteral("qtplc state"), QStringLiteral("qtplc state --json | jq -r .state")},
         Command::NoArguments,
         0,
         0,
         &showState},
        {"init",
         "",
         "Asks all nodes for their initial values.",
         "The state is Ready then.",
         {},
         {QStringLiteral("qtplc init")},
         Command::NoArguments,
         0,
         0,
         &initializeStates},
        {"start",
         "",
         "Starts the real-time phase: state Real time.",
         "Where the master wants starts to be armed, it is initialized and armed before,\n"
         "unless a token is given.",
         {{"cycles", "N", "Ends by itself after N cycles."}, {"token", "TOKEN", "The token that qtplc arm printed."}},
         {QStringLiteral("qtplc start"), QStringLiteral("qtplc start --cycles 1000")},
         Command::NoArguments,
         0,
         0,
         &startRealTime},
        {"arm",
         "",
         "Permits one start within the next 5 s.",
         "The first of two steps, for masters that want it, in state Ready: prints a\n"
         "token for start.",
         {},
         {QStringLiteral("qtplc arm"), QStringLiteral("qtplc start --token $(qtplc arm --json | jq -r .token)")},
         Command::NoArguments,
         0,
         0,
         &armMaster},
        {"stop",
         "",
         "Ends the real-time phase: state Off.",
         "A stop of a master at rest changes nothing.",
         {},
         {QStringLiteral("qtplc stop")},
         Command::NoArguments,
         0,
         0,
         &stopRealTime},
        {"safestop",
         "[REASON...]",
         "Stops safely: nothing moves until a reset.",
         "Cycles go on and tell all nodes their safe values. Possible in every state.",
         {},
         {QStringLiteral("qtplc safestop"), QStringLiteral("qtplc safestop smoke at the winch")},
         Command::NoArguments,
         0,
         any,
         &stopSafely},
        {"reset",
         "",
         "Leaves the safe stop or fault when the cause is gone.",
         "The state is Off then. Nothing moves by it: init and start follow.",
         {},
         {QStringLiteral("qtplc reset")},
         Command::NoArguments,
         0,
         0,
         &resetMaster},
        {"evict",
         "NAME",
         "Ends all connections of a node or person.",
         "NAME is that of a node, of an identity, or the one by which a tool has greeted.\n"
         "The name is refused until qtplc admit NAME, or until the master has ended.\n"
         "If a critical node is evicted while cycles run, the plant stops safely. No start\n"
         "begins without a node that the plant needs. Without security, everybody can come\n"
         "back under another name.",
         {},
         {QStringLiteral("qtplc evict Winch")},
         Command::NoArguments,
         1,
         1,
         &evict},
        {"admit",
         "NAME",
         "Lets a node or person in again that was evicted.",
         "It has to connect again; most nodes do so alone. qtplc state shows who is\n"
         "evicted.",
         {},
         {QStringLiteral("qtplc admit Winch")},
         Command::NoArguments,
         1,
         1,
         &admit},
        {"schedule",
         "",
         "Shows the order of the nodes, and how old links are.",
         "A stage begins when the one before has ended. The age of a link is the number of\n"
         "cycles from writing a value to reading it.",
         {},
         {QStringLiteral("qtplc schedule")},
         Command::NoArguments,
         0,
         0,
         &showSchedule},
        {"jitter",
         "",
         "Shows how punctual master and nodes are.",
         "Lateness: how long after its time a cycle began. Round trip: from the first\n"
         "request to the last answer. Execution: computing. Slack: what was left until the\n"
         "next cycle. Since the start, over the last 10 s, and the worst cycles.",
         {{"hist", "", "Draws histograms instead."}},
         {QStringLiteral("qtplc jitter"), QStringLiteral("qtplc jitter --hist"),
          QStringLiteral("qtplc jitter --json | jq .master.lateness.last10s.p99")},
         Command::NoArguments,
         0,
         0,
         &showJitter},
        {"leases",
         "",
         "Shows who has taken over which signals.",
         "A lease is lost when its holder is gone: the signal stays at its neutral value\n"
         "until somebody takes or releases it.",
         {},
         {QStringLiteral("qtplc leases"), QStringLiteral("qtplc leases --json | jq '.leases[].holder'")},
         Command::NoArguments,
         0,
         0,
         &showLeases},
        {"events",
         "",
         "Shows what has happened in the master.",
         "States, nodes, late answers, faults, values that were set, leases, overruns and\n"
         "notes: the last 1000. --json prints an object for each line. --file needs no\n"
         "master: it shows the events that one has written to FILE, and to the older files\n"
         "FILE.1, FILE.2, ... The option --events of a master says where they are. Of a\n"
         "recording (.mcap, or a folder) it also shows who has set which signal, and which\n"
         "cycle has adopted the value, and who held which lease.",
         {{"follow", "", "Goes on with what happens, until Ctrl-C."},
          {"file", "FILE", "Reads the events of an ended master, or a recording."},
          {"signal", "SIGNAL", "Of a recording: only who has set or held this signal."}},
         {QStringLiteral("qtplc events"), QStringLiteral("qtplc events --follow"),
          QStringLiteral("qtplc events --file /var/log/qtplc/awe_master-50000.jsonl"),
          QStringLiteral("qtplc events --file flight.mcap --signal tetherSpeed"),
          QStringLiteral("qtplc events --json | jq -r 'select(.severity != \"info\").text'")},
         Command::NoArguments,
         0,
         0,
         &showEvents},
        {"note",
         "TEXT...",
         "Notes down what you see, for events and recordings.",
         "The note is an event of the master with who wrote it, from where, and when: in\n"
         "qtplc events, in the Control Center, and at its cycle in every recording. At\n"
         "most 200 characters on one line. It keeps no files: qtplc record mark does.",
         {},
         {QStringLiteral("qtplc note the left steering line vibrates"),
          QStringLiteral("qtplc note \"gust from the north\"")},
         Command::NoArguments,
         1,
         any,
         &writeNote},
        {"find",
         "",
         "Finds masters, without knowing an address.",
         "Those of this computer and user, and those of the network that send beacons\n"
         "(--beacon). Anybody on a network can send one: compare address and table before\n"
         "you command what was found. The exit code is 1 when nothing was found.",
         {{"seconds", "SECONDS", "Looks for this time, default 2.5."}},
         {QStringLiteral("qtplc find"), QStringLiteral("qtplc find --seconds 6 --json | jq -r '.[].address'")},
         Command::NoArguments,
         0,
         0,
         &findMasters},
        {"keys",
         "new|list|revoke [IDENTITY]",
         "Makes, shows and revokes pre-shared keys.",
         "new makes a key for IDENTITY in the file --keys, which is made if need be and\n"
         "which only its owner may read; --role says what it may do: Observer, Operator,\n"
         "Node (unless said) or Engineer. --copy writes the key alone into another file,\n"
         "for the computer of IDENTITY. new replaces a key with --replace only. list shows\n"
         "identities and roles, never keys. A running master reads the file again for\n"
         "each connection, and twice in a second: connections of a revoked identity end.",
         {{"role", "ROLE", "What the identity may do, default Node."},
          {"copy", "FILE", "Writes the new key alone into FILE, too."},
          {"replace", "", "Replaces the key of an identity that has one."}},
         {QStringLiteral("qtplc keys new Winch --keys keys.ini --copy winch.ini"),
          QStringLiteral("qtplc keys new anna --role Operator --keys keys.ini --copy anna.ini"),
          QStringLiteral("qtplc keys revoke Winch --keys keys.ini")},
         Command::NoArguments,
         1,
         2,
         &manageKeys},
        {"manifest",
         "",
         "Prints a manifest of the plant that runs.",
         "A section for each node: critical or required, its transport, its own watchdog\n"
         "and its proven identity. Listeners are left out. Read it, correct it, and give\n"
         "it to the master: awe_master --manifest FILE.",
         {},
         {QStringLiteral("qtplc manifest > manifest.ini"),
          QStringLiteral("qtplc manifest --json | jq -r '.nodes[].name'")},
         Command::NoArguments,
         0,
         0,
         &writeManifest},
        {"check",
         "MANIFEST [TABLE]",
         "Checks a manifest, and whether it fits a signal table.",
         "Needs no master. The exit code is 2 when a file has errors: each of them has its\n"
         "line and a remedy. It is 1 when the table names writers of a signal, and the\n"
         "plant would start without any of them.",
         {},
         {QStringLiteral("qtplc check manifest.ini"), QStringLiteral("qtplc check manifest.ini signals.ini")},
         Command::NoArguments,
         1,
         2,
         &checkManifest},
        {"record",
         "FILE | FOLDER/ | VERB FOLDER | mark",
         "Records every cycle of plants, also of other computers.",
         "Reads the ring of a master, which runs on this computer and belongs to the same\n"
         "user, or with --master of one on another computer, and writes FILE, which must\n"
         "not exist. It begins with the cycles that are in the ring, and ends with the\n"
         "phase or at Ctrl-C. If it is killed, the ring keeps what is not in FILE: record\n"
         "into another file then, and run qtplc recover. With a FOLDER, it records all\n"
         "plants, one after the other and at once, until Ctrl-C. It makes a file for each\n"
         "phase and segment, and deletes the oldest ones. If it was killed, the next one\n"
         "in the same FOLDER finishes the files, and goes on. VERB asks the recorder of a\n"
         "FOLDER, also one in a master: stop ends its files until start, mark keeps the\n"
         "cycles from 30 s before to 10 s after, status prints what it does, and list the\n"
         "files. Without a FOLDER, mark asks the masters: they keep these cycles, also\n"
         "when nobody records.",
         {{"ring", "RING", "The ring of the master, default the only one."},
          {"plant", "NAME", "With a FOLDER: records the plant NAME alone."},
          {"segment-hours", "H", "With a FOLDER: a file is not longer, default 1."},
          {"segment-mib", "MIB", "With a FOLDER: a file is not larger, default 256."},
          {"keep-days", "DAYS", "With a FOLDER: older files are deleted."},
          {"keep-gib", "GIB", "With a FOLDER: keeps no more of them."},
          {"free-gib", "GIB", "With a FOLDER: keeps so much of the disk free, default 1."}},
         {QStringLiteral("qtplc record flight.mcap"), QStringLiteral("qtplc record flights/ --master 192.168.1.5"),
          QStringLiteral("qtplc record /var/lib/qtplc/ --keep-days 10 --keep-gib 50"),
          QStringLiteral("qtplc record mark /var/lib/qtplc"), QStringLiteral("qtplc record mark"),
          QStringLiteral("qtplc record list /var/lib/qtplc --json")},
         Command::NoArguments,
         1,
         2,
         &recordPlant},
        {"verify",
         "FILE|FOLDER",
         "Checks whether a recording has every cycle of a flight.",
         "Needs no master. It computes the digest of all images in FILE and compares it\n"
         "with the digest of the flight, which the master has computed. The exit code is 0\n"
         "only if all cycles from the first to the last are there, and equal. Otherwise it\n"
         "prints which cycles are missing, and what is damaged. In a FOLDER, it does this\n"
         "for each phase, whose files have to follow each other. Cycles of files that were\n"
         "deleted are named, and do not count as missing.",
         {},
         {QStringLiteral("qtplc verify flight.mcap"), QStringLiteral("qtplc verify flight.mcap --json | jq .gaps"),
          QStringLiteral("qtplc verify /var/lib/qtplc/recordings")},
         Command::NoArguments,
         1,
         1,
         &verifyFile},
        {"recover",
         "FILE",
         "Finishes a recording whose recorder was killed.",
         "Needs no master. It cuts off what is not whole at the end of FILE and writes the\n"
         "summary that other programs need. A finished recording stays as it is. The exit\n"
         "code is 1 when places within FILE are damaged: all that is whole stays readable.",
         {},
         {QStringLiteral("qtplc recover flight.mcap")},
         Command::NoArguments,
         1,
         1,
         &recoverFile},
        {"export",
         "FILE|FOLDER",
         "Writes a recording as a table: CSV, Parquet or MATLAB.",
         "A row for each cycle: time, number, values, and the quality of each signal (0\n"
         "Good, 1 to 252 Held, 253 Safe, 254 Invalid). The recordings of a folder are one.\n"
         "TIME is in seconds since the begin, or a moment as 2026-11-20T14:03:12 (UTC).\n"
         "Needs no master. The file appears when all of it is written. The exit code is 1\n"
         "when parts of the recording are damaged, or files of a folder are not\n"
         "recordings: the rest is in the table.",
         {output,
          {"format", "FORMAT", "csv, parquet or mat, default as the name of FILE ends."},
          {"signals", "LIST", "Names and patterns, such as 'power,kite.*'; default all."},
          from,
          upTo,
          {"every", "CYCLES", "One cycle of CYCLES only."},
          {"values-only", "", "No qualities."},
          force},
         {QStringLiteral("qtplc export flight.mcap -o flight.csv"),
          QStringLiteral("qtplc export flight.mcap -o power.mat --signals 'power,tether*' --to 60"),
          QStringLiteral("qtplc export recordings/ -o day.parquet --from 2026-11-20T08:00:00 --every 10"),
          QStringLiteral("qtplc export flight.mcap -o - --format csv | gzip > flight.csv.gz")},
         Command::NoArguments,
         1,
         1,
         &exportRecording},
        {"report",
         "FILE|FOLDER",
         "Writes a page about a recording that people can read.",
         "One file of HTML that needs no other: figures, plots, events, jitter, nodes and\n"
         "signals. --section adds text behind the figures: headings (#), tables with |,\n"
         "lists (-) and paragraphs, as in Markdown; - reads it from the standard input.\n"
         "With --layout, plots are those of a layout of the Control Center.\n"
         "TIME is in seconds since the begin, or a moment as 2026-11-20T14:03:12 (UTC).",
         {output,
          {"signals", "LIST", "Those that have plots; default the first that change."},
          from,
          upTo,
          {"section", "FILES", "Files with text, with commas between them."},
          {"layout", "FILE", "Layout whose time plots are drawn."},
          {"picture", "FILES", "Pictures (PNG, JPEG, SVG), with commas between them."},
          force},
         {QStringLiteral("qtplc report flight.mcap -o report.html"),
          QStringLiteral("qtplc report flight.mcap -o report.html --section power.md")},
         Command::NoArguments,
         1,
         1,
         &writeReport},
        {"replay",
         "FILE|FOLDER",
         "Lets a node compute again what a recording says.",
         "Needs no master. It starts the program of the node, gives it the inputs of the\n"
         "recording cycle by cycle, and with --compare compares its outputs with those of\n"
         "the recording, bit by bit, but for signals that are volatile in the table. The\n"
         "exit code is 1 when they differ, and 2 when the node cannot be replayed.\n"
         "A file in a folder of a recorder stands for all files of its phase, and a FOLDER\n"
         "for its newest phase.\n"
         "With --from, the node computes from its first cycle on, for its state, and\n"
         "outputs are compared from that time on.",
         {{"node", "COMMAND", "Program of the node with its arguments, without --master."},
          {"name", "NODE", "Node of the recording, default the one that registers."},
          {"compare", "", "Compares outputs, and prints the first difference."},
          {"from", "SECONDS", "Time of the flight to compare from, default 0."},
          {"speed", "SPEED", "lockstep (default), or a factor: 1 is real time."}},
         {QStringLiteral("qtplc replay flight.mcap --node awe_autopilot --compare"),
          QStringLiteral("qtplc replay flight.mcap --node 'gdb --args my_node --gain 3' --speed 1")},
         Command::NoArguments,
         1,
         1,
         &replayRecording},
        {"doctor",
         "",
         "Examines this computer: is it fit for real time?",
         "Names the command that cures each finding. Needs no master, and takes some\n"
         "two seconds: scheduling and locked memory are tried, wake-ups and a loopback\n"
         "round trip are measured. The exit code is 1 when something is to be cured.",
         {},
         {QStringLiteral("qtplc doctor"), QStringLiteral("qtplc doctor --json | jq .ok")},
         Command::NoArguments,
         0,
         0,
         &examineComputer},
        {"campaign",
         "",
         "Measures the jitter of this computer in many cases.",
         "All combinations of scheduling, periods, transports and loads. In each case, a\n"
         "master and its nodes run over the sockets of this computer, beside the load\n"
         "(stress-ng) and cyclictest (rt-tests), if it is installed. The folder gets a\n"
         "report (campaign.html) and its numbers (campaign.csv, histograms.csv,\n"
         "computer.csv) after each case: Ctrl-C keeps the cases that are complete. The\n"
         "report has neither the name of the computer nor that of its user. The exit\n"
         "code is 1 if a case is missing, or has notes.",
         {{"output", "FOLDER", "Gets the report; or -o FOLDER.", "o"},
          {"for", "SECONDS", "Length of each case, default 60."},
          {"periods", "TIMES", "Of the cycle, 100us to 1s, default 10ms,1ms."},
          {"transports", "NAMES", "Some of udp, tcp, local; default udp."},
          {"policies", "NAMES", "Some of other, fifo; default both."},
          {"loads", "NAMES", "Some of idle, cpu, memory, disk, network."},
          {"command", "COMMAND", "A load of your own, for the shell."},
          {"nodes", "N", "Nodes of the plant, 1 to 32, default 3."},
          {"priority", "P", "Of the policy fifo, 2 to 98, default 49."},
          {"cpu", "CPU", "The processor for the cycle of the master."},
          force},
         {QStringLiteral("sudo qtplc campaign -o jitter"),
          QStringLiteral("qtplc campaign -o quick --for 5 --loads idle --policies other")},
         Command::NoArguments,
         0,
         0,
         &runCampaign},
        {"help",
         "[COMMAND]",
         "Explains a command.",
         "",
         {},
         {QStringLiteral("qtplc help watch")},
         Command::CommandNames,
         0,
         1,
         &showHelp},
        {"complete",
         "WORD...",
         "Prints how a command line may go on, for the shell.",
         "The last WORD is the one that goes on. The names of signals are asked of the\n"
         "master; without one there are none. The completion of bash calls this command:\n"
         "source share/bash-completion/completions/qtplc.",
         {},
         {QStringLiteral("qtplc complete -- qtplc get tether")},
         Command::NoArguments,
         0,
         any,
         &completeWord},
    };
    return table;
}

const Command *findCommand(const QString &name)
{
    for (const Command &command : commands()) {
        if (name == QLatin1String(command.name))
            return &command;
    }
    return nullptr;
}

QString unknownCommand(const QString &name)
{
    QStringList names;
    for (const Command &command : commands())
        names << QString::fromLatin1(command.name);
    const QStringList close = qplc::closeNames(name, names);
    const QString remedy = close.isEmpty() ? QStringLiteral("; use one of %1").arg(names.join(QStringLiteral(", ")))
                                           : qplc::didYouMean(close);
    return (name.isEmpty() ? QStringLiteral("no command") : QStringLiteral("unknown command '%1'").arg(printable(name)))
        + remedy;
}

const QVector<Option> &commonOptions()
{
    static const QVector<Option> options{
        {"master", "HOST:PORT", "Where the master is, default 127.0.0.1:50000."},
        {"timeout", "SECONDS", "Longest wait for an answer, default 5."},
        {"json", "", "Prints JSON (echo, watch, events: an object a line)."},
        {"security", "psk|cert", "TLS with pre-shared keys, or with certificates."},
        {"keys", "FILE", "For psk: keys of identities."},
        {"identity", "NAME", "For psk: who you are, default the only one in FILE."},
        {"certificate", "FILE", "For cert: your certificate (PEM)."},
        {"key", "FILE", "For cert: its private key (PEM)."},
        {"authority", "FILE", "For cert: certificate of the authority (PEM)."},
    };
    return options;
}

}  // namespace tools
