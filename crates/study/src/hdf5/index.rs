//! Where things are: the trees of chunks, the tables of groups, and the superblock.

use super::encode::{Heap, NOWHERE, header, padded, terminated};
use super::{Kind, Object, misuse};
use std::io;

/// Bytes of the superblock with the entry of the root group.
pub(super) const SUPERBLOCK_SIZE: u64 = 96;
/// Half the children of a node of a chunk tree: the value that superblock 0 implies.
const CHUNK_TREE_K: usize = 32;
/// Half the children of a node of a group's tree, and half the members of one of its tables.
const GROUP_TREE_K: u16 = 16;
const GROUP_TABLE_K: u16 = 32;
const MEMBERS_PER_TABLE: usize = 2 * GROUP_TABLE_K as usize;
const TABLES: usize = 2 * GROUP_TREE_K as usize;
const TABLE_BYTES: usize = 8 + 40 * MEMBERS_PER_TABLE;
const GROUP_TREE_BYTES: usize = 24 + 8 * (2 * TABLES + 1);
/// Bytes of a local heap's head.
const NAMES_HEAD: usize = 32;

/// One chunk of a dataset on the disk.
#[derive(Debug, Clone)]
pub(super) struct Chunk {
    /// Index of its first element in each dimension.
    pub(super) offset: Vec<u64>,
    pub(super) address: u64,
    /// Bytes on the disk.
    pub(super) size: u32,
}

/// Start of a node of a tree. Siblings are left out: readers come from above.
fn node(kind: u8, level: u8, children: usize) -> Vec<u8> {
    let mut bytes = b"TREE".to_vec();
    bytes.extend([kind, level]);
    bytes.extend((children as u16).to_le_bytes());
    bytes.extend(NOWHERE.to_le_bytes());
    bytes.extend(NOWHERE.to_le_bytes());
    bytes
}

/// The tree over the chunks of a dataset (in ascending order) for a place in the file, and the address
/// of its root.
pub(super) fn chunk_tree(chunks: &[Chunk], dims: &[u32], address: u64) -> (Vec<u8>, u64) {
    let key = |offset: &[u64], size: u32| {
        let mut bytes = size.to_le_bytes().to_vec();
        bytes.extend([0; 4]); // every filter was used
        bytes.extend(offset.iter().chain([&0]).flat_map(|n| n.to_le_bytes()));
        bytes
    };
    let key_size = 8 + 8 * (dims.len() + 1);
    let node_size = 24 + 2 * CHUNK_TREE_K * 8 + (2 * CHUNK_TREE_K + 1) * key_size;
    // The key after the last chunk is beyond it in every dimension.
    let last = chunks.last().map_or_else(Vec::new, |chunk| {
        let beyond = chunk
            .offset
            .iter()
            .zip(dims)
            .map(|(at, n)| at + u64::from(*n));
        beyond.collect()
    });
    let mut children: Vec<(Vec<u8>, u64)> = chunks
        .iter()
        .map(|chunk| (key(&chunk.offset, chunk.size), chunk.address))
        .collect();
    let end = key(&last, 0);
    let mut bytes: Vec<u8> = Vec::new();
    for level in 0.. {
        let mut parents = Vec::new();
        let starts: Vec<usize> = (0..children.len()).step_by(2 * CHUNK_TREE_K).collect();
        for start in starts {
            let stop = (start + 2 * CHUNK_TREE_K).min(children.len());
            let at = address + bytes.len() as u64;
            let mut node = node(1, level, stop - start);
            for (key, child) in &children[start..stop] {
                node.extend(key);
                node.extend(child.to_le_bytes());
            }
            node.extend(children.get(stop).map_or(&end, |(key, _)| key));
            node.resize(node_size, 0);
            bytes.extend(node);
            parents.push((children[start].0.clone(), at));
        }
        if let [(_, root)] = parents[..] {
            return (bytes, root);
        }
        children = parents;
    }
    (bytes, NOWHERE)
}

/// Where the description of the file will stand.
pub(super) struct Plan {
    /// Address of the header of each object.
    pub(super) headers: Vec<u64>,
    /// For groups: addresses of tree and heap of names.
    tables: Vec<[u64; 2]>,
}

impl Plan {
    /// Headers one after another from `address` on, then tree, names and tables of each group.
    pub(super) fn new(objects: &[Object], heap: &Heap, address: u64) -> io::Result<Self> {
        let mut place = address;
        let unknown = vec![0; objects.len()];
        let mut headers = Vec::new();
        for index in 0..objects.len() {
            headers.push(place);
            place += header(objects, index, &unknown, [0; 2], heap)?.len() as u64;
        }
        let mut tables = Vec::new();
        for object in objects {
            tables.push([place, place + GROUP_TREE_BYTES as u64]);
            if let Kind::Group(members) = &object.kind {
                if members.len() > TABLES * MEMBERS_PER_TABLE {
                    return Err(misuse(format!("{} has too many members", object.name)));
                }
                place += group(objects, members, &unknown, 0).len() as u64;
            }
        }
        Ok(Self { headers, tables })
    }

    /// The description.
    pub(super) fn bytes(&self, objects: &[Object], heap: &Heap) -> io::Result<Vec<u8>> {
        let mut bytes = Vec::new();
        for (index, table) in self.tables.iter().enumerate() {
            bytes.extend(header(objects, index, &self.headers, *table, heap)?);
        }
        for (object, table) in objects.iter().zip(&self.tables) {
            if let Kind::Group(members) = &object.kind {
                bytes.extend(group(objects, members, &self.headers, table[0]));
            }
        }
        Ok(bytes)
    }

    /// The superblock of a file of `length` bytes.
    pub(super) fn superblock(&self, length: u64) -> Vec<u8> {
        let mut bytes = b"\x89HDF\r\n\x1a\n".to_vec();
        bytes.extend([0, 0, 0, 0, 0, 8, 8, 0]); // versions; addresses and lengths of 8 bytes
        bytes.extend(GROUP_TABLE_K.to_le_bytes());
        bytes.extend(GROUP_TREE_K.to_le_bytes());
        bytes.extend([0; 4]);
        for address in [0, NOWHERE, length, NOWHERE, 0, self.headers[0]] {
            bytes.extend(address.to_le_bytes());
        }
        // The entry of the root holds a copy of where its table is.
        bytes.extend([1, 0, 0, 0, 0, 0, 0, 0]);
        bytes.extend(self.tables[0].iter().flat_map(|n| n.to_le_bytes()));
        bytes
    }
}

/// Tree, names and tables of a group that stand at `address`.
fn group(objects: &[Object], members: &[usize], headers: &[u64], address: u64) -> Vec<u8> {
    let mut members = members.to_vec();
    members.sort_by(|a, b| objects[*a].name.as_bytes().cmp(objects[*b].name.as_bytes()));
    // The empty name comes first: the lower bound of all.
    let mut names = vec![0; 8];
    let offsets: Vec<u64> = members
        .iter()
        .map(|member| {
            let offset = names.len() as u64;
            names.extend(padded(&terminated(&objects[*member].name)));
            offset
        })
        .collect();
    let first_table = address + (GROUP_TREE_BYTES + NAMES_HEAD + names.len()) as u64;
    let entries: Vec<(u64, u64)> = offsets
        .iter()
        .zip(&members)
        .map(|(offset, member)| (*offset, headers[*member]))
        .collect();
    let tables: Vec<&[(u64, u64)]> = entries.chunks(MEMBERS_PER_TABLE).collect();

    let mut bytes = node(0, 0, tables.len());
    bytes.extend([0; 8]);
    for (number, table) in tables.iter().enumerate() {
        bytes.extend((first_table + (number * TABLE_BYTES) as u64).to_le_bytes());
        bytes.extend(table.last().map_or(0, |entry| entry.0).to_le_bytes());
    }
    bytes.resize(GROUP_TREE_BYTES, 0);

    /// No free space in a heap of names.
    const NO_FREE: u64 = 1;
    bytes.extend(b"HEAP\0\0\0\0");
    let names_at = address + (GROUP_TREE_BYTES + NAMES_HEAD) as u64;
    for value in [names.len() as u64, NO_FREE, names_at] {
        bytes.extend(value.to_le_bytes());
    }
    bytes.extend(names);
    for table in tables {
        let start = bytes.len();
        bytes.extend(b"SNOD\x01\0");
        bytes.extend((table.len() as u16).to_le_bytes());
        for (name, header) in table {
            bytes.extend(name.to_le_bytes());
            bytes.extend(header.to_le_bytes());
            bytes.extend([0; 24]);
        }
        bytes.resize(start + TABLE_BYTES, 0);
    }
    bytes
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "a test may stop at the first surprise")]
mod tests {
    use super::*;

    /// Addresses of the chunks under a node, found as a reader finds them.
    fn chunks_under(bytes: &[u8], start: u64, address: u64, key: usize) -> Vec<u64> {
        let node = &bytes[(address - start) as usize..];
        assert_eq!(node[..5], *b"TREE\x01");
        let count = usize::from(u16::from_le_bytes(node[6..8].try_into().unwrap()));
        assert!((1..=2 * CHUNK_TREE_K).contains(&count));
        let child = |number: usize| {
            let at = 24 + number * (key + 8) + key;
            u64::from_le_bytes(node[at..at + 8].try_into().unwrap())
        };
        if node[5] == 0 {
            return (0..count).map(child).collect();
        }
        let children = (0..count).map(child);
        children
            .flat_map(|child| chunks_under(bytes, start, child, key))
            .collect()
    }

    #[test]
    fn a_tree_of_any_height_holds_every_chunk_in_order() {
        for count in [1, 64, 65, 4096, 4500] {
            let chunks: Vec<Chunk> = (0..count)
                .map(|number| Chunk {
                    offset: vec![2 * number, 0, 0],
                    address: 7 * number + 1,
                    size: 5,
                })
                .collect();
            let (bytes, root) = chunk_tree(&chunks, &[2, 3, 4], 1000);
            let found = chunks_under(&bytes, 1000, root, 8 + 8 * 4);
            let expected: Vec<u64> = chunks.iter().map(|chunk| chunk.address).collect();
            assert_eq!(found, expected, "{count}");
        }
    }
}
