/** \file
 * How the ranks of a distributed computation reach each other: an interface for any transport. For MPI see
 * powercell_mpi.h.
 */
#ifndef POWERCELL_C_COMMUNICATOR_H
#define POWERCELL_C_COMMUNICATOR_H

#include <powercell/c/base.h>

#ifdef __cplusplus
extern "C" {
#endif

/** Bytes for a rank. This struct does not grow. */
typedef struct pc_message {
  const void* bytes; /**< NULL if there are none */
  size_t size;       /**< bytes; may be more than 2^31 */
} pc_message;

/** Where the messages to this rank are put, for as long as an exchange. */
typedef struct pc_mailbox pc_mailbox;

/** Makes room for the message that a rank has sent. It belongs to the library, as what was sent does, so an
 * exchange has nothing to free, however it ends. Ranks without room have sent an empty message.
 * PC_INVALID_ARGUMENT: no such rank, or a second message of it. Where this fails, the exchange fails with the
 * same status and message, whatever it answers.
 * \param from  the rank that it comes from
 * \param size  bytes
 * \param room  size bytes, to be written before the exchange returns; NULL for size 0 */
POWERCELL_API pc_status pc_mailbox_room(pc_mailbox* mailbox, int from, size_t size, void** room);

/** Sends a message to each rank and returns when all that are sent to this one are in the mailbox. All ranks
 * call it equally often and in the same order, each in the thread that called the library. It must not wait
 * for ever for a rank that is gone, but answer 0 or end the program. A callback of C++ that throws fails as
 * with the answer 0, and its exception is the message.
 * \param messages  one for each rank, by the rank that it goes to, this one included; they last until it
 *        returns
 * \return 0 to end the call on this rank with PC_INTERRUPTED, without a word to the others */
typedef int (*pc_exchange)(const pc_message* messages, pc_mailbox* mailbox, void* user);

/** A rank of several that compute together: processes, or threads of one. Fill with pc_communicator_init()
 * first. Functions copy it; `user` must last as long as the call, or as the handle that it makes. */
typedef struct pc_communicator {
  size_t struct_size;   /**< set by pc_communicator_init() */
  int rank;             /**< from 0 */
  int size;             /**< the number of ranks */
  pc_exchange exchange; /**< must be set, also for one rank */
  void* user;           /**< passed to exchange */
} pc_communicator;

/** Sets everything to 0. \param struct_size  sizeof(pc_communicator) */
POWERCELL_API pc_status pc_communicator_init(pc_communicator* communicator, size_t struct_size);

#ifdef __cplusplus
}
#endif
#endif
