/** \file
 * A pc_communicator over MPI, in C99. In this header alone: the libraries of powercell do not know of MPI,
 * and any MPI of at least version 3 can be used with them. CMake: find_package(powercell COMPONENTS mpi) has
 * powercell::mpi.
 */
#ifndef POWERCELL_MPI_H
#define POWERCELL_MPI_H

#ifdef __cplusplus
/* Of the C++ bindings, which MPI 3 has removed, some headers still have remains that cause warnings. */
#ifndef OMPI_SKIP_MPICXX
#define OMPI_SKIP_MPICXX 1
#endif
#ifndef MPICH_SKIP_MPICXX
#define MPICH_SKIP_MPICXX 1
#endif
#endif
#include <limits.h>
#include <mpi.h>
#include <powercell/c/communicator.h>
#include <stdlib.h>
#include <string.h>

#ifdef __cplusplus
extern "C" {
#endif

/** What a communicator over MPI works with; its members are not for callers. Arrays are by rank. */
typedef struct pc_mpi_ranks {
  MPI_Comm own;
  int count;
  size_t most;              /* bytes for each rank in one call of MPI_Alltoallv */
  uint64_t *sizes, *coming; /* of the messages to each rank, and of those from each */
  unsigned char** room;
  int *sent, *sent_at, *got, *got_at; /* counts and places within a call of MPI are int */
} pc_mpi_ranks;

static inline void pc_mpi_ranks_free(pc_mpi_ranks* ranks) {
  int is_over = 0;
  if (!ranks) return;
  MPI_Finalized(&is_over); /* after it there is nothing left to free */
  if (!is_over) MPI_Comm_free(&ranks->own);
  free(ranks->sizes);
  free(ranks->coming);
  free(ranks->room);
  free(ranks->sent);
  free(ranks->sent_at);
  free(ranks->got);
  free(ranks->got_at);
  free(ranks);
}

/* The bytes of a piece for each rank, and where they begin in a buffer. Returns those of all. */
static inline int pc_mpi_lay_out(const pc_mpi_ranks* ranks, const uint64_t* sizes, uint64_t begin, int* count,
                                 int* at) {
  int bytes = 0, r;
  for (r = 0; r < ranks->count; ++r) {
    const uint64_t left = sizes[r] > begin ? sizes[r] - begin : 0;
    count[r] = (int)(left < ranks->most ? left : ranks->most);
    at[r] = bytes;
    bytes += count[r];
  }
  return bytes;
}

static inline void pc_mpi_exchange_piece(pc_mpi_ranks* ranks, const pc_message* messages, uint64_t begin,
                                         unsigned char* sent, unsigned char* got) {
  int r;
  pc_mpi_lay_out(ranks, ranks->sizes, begin, ranks->sent, ranks->sent_at);
  pc_mpi_lay_out(ranks, ranks->coming, begin, ranks->got, ranks->got_at);
  for (r = 0; r < ranks->count; ++r)
    if (ranks->sent[r] > 0)
      memcpy(sent + ranks->sent_at[r], (const unsigned char*)messages[r].bytes + begin,
             (size_t)ranks->sent[r]);
  MPI_Alltoallv(sent, ranks->sent, ranks->sent_at, MPI_BYTE, got, ranks->got, ranks->got_at, MPI_BYTE,
                ranks->own);
  for (r = 0; r < ranks->count; ++r)
    if (ranks->got[r] > 0) memcpy(ranks->room[r] + begin, got + ranks->got_at[r], (size_t)ranks->got[r]);
}

/* The pc_exchange. Where a rank lacks memory, it ends on all, as others would wait for it for ever. */
static inline int pc_mpi_exchange(const pc_message* messages, pc_mailbox* mailbox, void* user) {
  pc_mpi_ranks* const ranks = (pc_mpi_ranks*)user;
  uint64_t of_all[2] = {0, 0}; /* the longest message; whether memory is lacking */
  uint64_t begin;
  unsigned char *sent, *got;
  int r;
  for (r = 0; r < ranks->count; ++r) {
    ranks->sizes[r] = messages[r].size;
    if (of_all[0] < messages[r].size) of_all[0] = messages[r].size;
  }
  MPI_Alltoall(ranks->sizes, 1, MPI_UINT64_T, ranks->coming, 1, MPI_UINT64_T, ranks->own);
  for (r = 0; r < ranks->count; ++r) {
    void* room = NULL;
    if (pc_mailbox_room(mailbox, r, (size_t)ranks->coming[r], &room) != PC_OK) of_all[1] = 1;
    ranks->room[r] = (unsigned char*)room;
  }
  /* No piece is longer than the first. */
  sent =
      (unsigned char*)malloc((size_t)pc_mpi_lay_out(ranks, ranks->sizes, 0, ranks->sent, ranks->sent_at) + 1);
  got =
      (unsigned char*)malloc((size_t)pc_mpi_lay_out(ranks, ranks->coming, 0, ranks->got, ranks->got_at) + 1);
  if (!sent || !got) of_all[1] = 1;
  MPI_Allreduce(MPI_IN_PLACE, of_all, 2, MPI_UINT64_T, MPI_MAX, ranks->own);
  for (begin = 0; of_all[1] == 0 && begin < of_all[0]; begin += ranks->most)
    pc_mpi_exchange_piece(ranks, messages, begin, sent, got);
  free(sent);
  free(got);
  return of_all[1] == 0;
}

/* NULL where there is no memory. The communicator is freed with it. */
static inline pc_mpi_ranks* pc_mpi_ranks_new(MPI_Comm own, int count, size_t most) {
  const size_t n = (size_t)count;
  pc_mpi_ranks* const ranks = (pc_mpi_ranks*)calloc(1, sizeof(pc_mpi_ranks));
  if (!ranks) return NULL;
  ranks->own = own;
  ranks->count = count;
  ranks->most = most;
  ranks->sizes = (uint64_t*)malloc(n * sizeof(uint64_t));
  ranks->coming = (uint64_t*)malloc(n * sizeof(uint64_t));
  ranks->room = (unsigned char**)malloc(n * sizeof(unsigned char*));
  ranks->sent = (int*)malloc(n * sizeof(int));
  ranks->sent_at = (int*)malloc(n * sizeof(int));
  ranks->got = (int*)malloc(n * sizeof(int));
  ranks->got_at = (int*)malloc(n * sizeof(int));
  return ranks;
}

/* Whether all ranks have their memory; else it is freed on all. */
static inline int pc_mpi_all_have(pc_mpi_ranks* ranks, MPI_Comm own) {
  int has_all = ranks && ranks->sizes && ranks->coming && ranks->room && ranks->sent && ranks->sent_at &&
                ranks->got && ranks->got_at;
  MPI_Allreduce(MPI_IN_PLACE, &has_all, 1, MPI_INT, MPI_MIN, own);
  if (has_all) return 1;
  if (ranks)
    pc_mpi_ranks_free(ranks);
  else
    MPI_Comm_free(&own);
  return 0;
}

/** Fills a communicator of the ranks of an MPI communicator, between MPI_Init and MPI_Finalize. That is
 * duplicated, so that messages of the library never meet those of the caller: all its ranks must call this at
 * the same time. MPI is called in the thread that calls the library, so MPI_THREAD_FUNNELED is enough where
 * that is the thread of MPI_Init_thread. An error of MPI ends the job, as others would wait for ever.
 * PC_INVALID_ARGUMENT: MPI is not running, an intercommunicator, less than a byte for each rank.
 * PC_OUT_OF_MEMORY: on all ranks alike.
 * \param most_bytes  that a rank sends in one call of MPI_Alltoallv; longer messages are sent in pieces. So
 *        many bytes are taken in memory twice. The same on all ranks; 0 for 2^28
 * \param communicator  to be freed by pc_mpi_communicator_destroy() */
static inline pc_status pc_mpi_communicator_create(MPI_Comm of, size_t most_bytes,
                                                   pc_communicator* communicator) {
  int is_running = 0, is_over = 0, is_between = 0, count = 0;
  MPI_Comm own = MPI_COMM_NULL;
  pc_mpi_ranks* ranks;
  const pc_status status = pc_communicator_init(communicator, sizeof(pc_communicator));
  if (status != PC_OK) return status;
  MPI_Initialized(&is_running);
  MPI_Finalized(&is_over);
  if (!is_running || is_over)
    return pc_fail(PC_INVALID_ARGUMENT, "a communicator over MPI is made between MPI_Init and MPI_Finalize");
  MPI_Comm_test_inter(of, &is_between);
  if (is_between) return pc_fail(PC_INVALID_ARGUMENT, "a communicator over MPI needs an intracommunicator");
  MPI_Comm_size(of, &count);
  if (most_bytes == 0) most_bytes = (size_t)1 << 28;
  if (most_bytes > INT_MAX) most_bytes = INT_MAX;
  if (most_bytes < (size_t)count)
    return pc_fail(PC_INVALID_ARGUMENT,
                   "a communicator over MPI needs at least a byte for each rank at a time");
  MPI_Comm_dup(of, &own);
  MPI_Comm_set_errhandler(own, MPI_ERRORS_ARE_FATAL);
  ranks = pc_mpi_ranks_new(own, count, most_bytes / (size_t)count);
  if (!pc_mpi_all_have(ranks, own))
    return pc_fail(PC_OUT_OF_MEMORY, "out of host memory for a communicator over MPI");
  MPI_Comm_rank(own, &communicator->rank);
  communicator->size = count;
  communicator->exchange = pc_mpi_exchange;
  communicator->user = ranks;
  return PC_OK;
}

/** Frees what pc_mpi_communicator_create() made, the duplicate too, which all ranks do together; the struct
 * is then without an exchange. Accepts NULL, what could not be created or is destroyed already, and any after
 * MPI_Finalize. */
static inline void pc_mpi_communicator_destroy(pc_communicator* communicator) {
  if (!communicator || !communicator->user) return;
  pc_mpi_ranks_free((pc_mpi_ranks*)communicator->user);
  communicator->exchange = NULL;
  communicator->user = NULL;
}

#ifdef __cplusplus
}
#endif
#endif
