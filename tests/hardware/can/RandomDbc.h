// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <QtCore/QByteArrayList>
#include <QtCore/QRandomGenerator>
#include <QtCore/QVector>

#include <bitset>

/// Makes messages with signals at random places that do not overlap, as a DBC file, out of a seed.
class RandomDbc
{
public:
    struct Signal
    {
        QByteArray name;
        int start = 0;
        int length = 1;
        bool isIntel = true;
        bool isSigned = false;
        bool isFloat = false;
        int page = -1;  // -1: on all
        bool isMultiplexor = false;
        QByteArray scale;        // "(factor,offset)"
        QByteArray multiplexor;  // name, of extended multiplexing: with the ranges
        QByteArray ranges;       // "0-3, 5-5"
    };
    struct Message
    {
        QByteArray name;
        quint32 id = 0;
        int size = 8;
        int pages = 0;  // 0: not multiplexed
        QVector<Signal> content;
    };

    explicit RandomDbc(quint32 seed)
        : m_random(seed)
    {
    }

    /// \param signalCount  at least
    QVector<Message> messages(int signalCount)
    {
        QVector<Message> messages;
        for (int count = 0; count < signalCount; count += messages.constLast().content.size())
            messages.append(message(messages.size()));
        return messages;
    }

    /// Messages of J1939 with extended multiplexing: a multiplexor, others on some of its pages,
    /// and signals on ranges of pages of all of them.
    QVector<Message> networkMessages(int count)
    {
        QVector<Message> messages;
        for (int i = 0; i < count; ++i)
            messages.append(networkMessage(i));
        return messages;
    }

    /// \param isNetwork  of J1939
    static QByteArray text(const QVector<Message> &messages, bool isNetwork = false)
    {
        QByteArray attributes;
        if (isNetwork)
            attributes = "BA_DEF_ BO_ \"VFrameFormat\" ENUM \"StandardCAN\",\"ExtendedCAN\",\"reserved\","
                         "\"J1939PG\";\nBA_DEF_DEF_ \"VFrameFormat\" \"J1939PG\";\n";
        QByteArray text = "VERSION \"\"\n\nNS_ :\n\nBS_:\n\nBU_: A B\n\n";
        QByteArray kinds;
        QByteArray ranges;
        for (const Message &message : messages) {
            const QByteArray id = QByteArray::number(message.id);
            text += "BO_ " + id + ' ' + message.name + ": " + QByteArray::number(message.size) + " A\n";
            for (const Signal &signal : message.content) {
                text += line(signal);
                if (!signal.ranges.isEmpty())
                    ranges += "SG_MUL_VAL_ " + id + ' ' + signal.name + ' ' + signal.multiplexor + ' ' + signal.ranges
                        + ";\n";
                if (signal.isFloat)
                    kinds += "SIG_VALTYPE_ " + id + ' ' + signal.name + (signal.length == 32 ? " : 1;\n" : " : 2;\n");
            }
            if (isNetwork)
                attributes += "BA_ \"VFrameFormat\" BO_ " + id + " 3;\n";
            text += '\n';
        }
        return text + attributes + kinds + ranges;
    }

    quint64 bits() { return m_random.generate64(); }
    int below(int end) { return int(m_random.bounded(end)); }

private:
    using Bits = std::bitset<512>;

    static QByteArray line(const Signal &signal)
    {
        const QByteArray page = !signal.ranges.isEmpty() ? signal.ranges.left(signal.ranges.indexOf('-'))
            : signal.page >= 0                           ? QByteArray::number(signal.page)
                                                         : QByteArray();
        const QByteArray prefix
            = page.isEmpty() ? (signal.isMultiplexor ? QByteArray(" ") : QByteArray()) : " m" + page;
        const QByteArray role = prefix + (signal.isMultiplexor ? "M" : "");
        return " SG_ " + signal.name + role + " : " + QByteArray::number(signal.start) + '|'
            + QByteArray::number(signal.length) + (signal.isIntel ? "@1" : "@0")
            + (signal.isSigned || signal.isFloat ? "- " : "+ ") + signal.scale + " [0|0] \"\" B\n";
    }

    Message message(int number)
    {
        static const int sizes[] = {1, 2, 3, 4, 5, 6, 7, 8, 8, 8, 8, 8, 12, 16, 20, 24, 32, 48, 64};
        Message message;
        message.name = "M" + QByteArray::number(number);
        message.id = number < 1000 ? quint32(number) : 0x80000000U + quint32(number) * 1000;
        message.size = sizes[below(int(std::size(sizes)))];
        Bits common;
        if (below(3) == 0)
            addMultiplexor(&message, &common);
        const int pages = message.pages;
        for (int i = below(3); i >= 0; --i)
            addSignal(&message, -1, &common);
        for (int page = 0; page < pages; ++page) {
            Bits used = common;
            for (int i = below(3); i >= 0; --i)
                addSignal(&message, page, &used);
        }
        return message;
    }

    Message networkMessage(int number)
    {
        Message message;
        message.name = "N" + QByteArray::number(number);
        // Every third group is for one node (PDU1): its id has a destination.
        const quint32 group = number % 3 == 0 ? quint32(number % 200) << 8 | 0x00FF : 0xF000U + quint32(number) * 7;
        message.id = 0x80000000U | quint32(below(8)) << 26 | quint32(number % 2) << 24 | group << 8 | 0xFE;
        Bits common;
        const QByteArray root = addSelector(&message, {}, {}, 4, &common);
        addSignal(&message, -1, &common, 8);
        for (const QByteArray &ranges : deal(16, 3)) {
            Bits used = common;
            if (below(2) == 0) {
                const QByteArray sub = addSelector(&message, root, ranges, 3, &used);
                for (const QByteArray &subRanges : deal(8, 2)) {
                    Bits usedThere = used;
                    addSignalOn(&message, sub, subRanges, &usedThere);
                }
            }
            for (int i = below(2); i >= 0 && used.count() < 40; --i)
                addSignalOn(&message, root, ranges, &used);
        }
        return message;
    }

    // Gives each of so many pages to one of the groups. Returns the ranges of each group with any.
    QVector<QByteArray> deal(int pages, int groups)
    {
        QVector<QByteArrayList> ranges(groups);
        for (int page = 0; page < pages;) {
            const int last = qMin(pages - 1, page + below(4));
            ranges[below(groups)] << QByteArray::number(page) + '-' + QByteArray::number(last);
            page = last + 1;
        }
        QVector<QByteArray> texts;
        for (const QByteArrayList &list : qAsConst(ranges)) {
            if (!list.isEmpty())
                texts << list.join(", ");
        }
        return texts;
    }

    QByteArray addSelector(Message *message, const QByteArray &multiplexor, const QByteArray &ranges, int length,
                           Bits *used)
    {
        for (;;) {
            Signal signal = place(message->size, length);
            signal.isMultiplexor = true;
            signal.isSigned = false;
            signal.scale = "(1,0)";
            signal.multiplexor = multiplexor;
            signal.ranges = ranges;
            if (put(message, signal, used))
                return message->content.constLast().name;
        }
    }

    void addSignalOn(Message *message, const QByteArray &multiplexor, const QByteArray &ranges, Bits *used)
    {
        const int before = message->content.size();
        addSignal(message, -1, used, 32);
        for (int i = before; i < message->content.size(); ++i) {
            message->content[i].multiplexor = multiplexor;
            message->content[i].ranges = ranges;
        }
    }

    void addMultiplexor(Message *message, Bits *used)
    {
        Signal signal = place(message->size, 1 + below(8));
        signal.isMultiplexor = true;
        signal.isSigned = false;
        signal.scale = "(1,0)";
        if (put(message, signal, used))
            message->pages = 2 + (signal.length > 1 ? below(2) : 0);
    }

    void addSignal(Message *message, int page, Bits *used, int longest = 64)
    {
        for (int attempt = 0; attempt < 20; ++attempt) {
            Signal signal = place(message->size, longest == 64 && below(4) == 0 ? 64 - below(8) : 1 + below(longest));
            signal.isFloat = (signal.length == 32 || signal.length == 64) && below(2) == 0;
            signal.page = page;
            if (put(message, signal, used))
                return;
        }
    }

    Signal place(int size, int length)
    {
        static const char *const scales[]
            = {"(1,0)", "(0.1,0)", "(0.25,-40)", "(0.001,100.5)", "(2,0)", "(-0.5,7)", "(1e-05,0)", "(3600,-1)"};
        Signal signal;
        signal.length = length;
        signal.isIntel = below(2) == 0;
        signal.isSigned = below(2) == 0;
        signal.start = below(size * 8);
        signal.scale = scales[below(int(std::size(scales)))];
        return signal;
    }

    // Takes the bits of a signal, if the message has them and nobody else does.
    static bool put(Message *message, Signal signal, Bits *used)
    {
        Bits wanted;
        int bit = signal.start;
        for (int i = 0; i < signal.length; ++i) {
            if (bit >= message->size * 8 || used->test(std::size_t(bit)))
                return false;
            wanted.set(std::size_t(bit));
            bit = signal.isIntel ? bit + 1 : bit % 8 == 0 ? bit + 15 : bit - 1;
        }
        *used |= wanted;
        signal.name = "S" + QByteArray::number(message->content.size());
        message->content.append(signal);
        return true;
    }

    QRandomGenerator m_random;
};
