//! HDF5 files, written front to back.
//!
//! Data go to the disk as they come, so that a dataset may be larger than the memory; what describes
//! them (headers, groups, indices) follows at the end, and the superblock at the start is filled in
//! last. Of the format this writes the part that every reader since HDF5 1.6 understands: superblock
//! 0, object headers 1, groups as symbol tables, datasets contiguous or in chunks that are shuffled
//! and deflated, attributes, dimension scales.
//!
//! A crate was not taken for it: none in pure Rust writes a dataset of several dimensions piece by
//! piece, or attaches dimension scales.
//!
//! Reference: The HDF Group, *HDF5 File Format Specification Version 2.0*; *HDF5 Dimension Scale
//! Specification*.

mod encode;
mod index;

use encode::{Heap, Layout, Type};
use flate2::Compression;
use flate2::write::ZlibEncoder;
use index::{Chunk, SUPERBLOCK_SIZE};
use std::io::{self, Seek, SeekFrom, Write};

/// Bytes of a chunk before compression, about: small enough to hold, large enough to compress.
const CHUNK_BYTES: usize = 1 << 18;
/// Fewer values than this are not worth a chunk and its index.
const FEWEST_CHUNKED: usize = 256;

/// A group or dataset of a file that is being written.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Node(usize);

/// Value of an attribute.
#[derive(Debug, Clone, PartialEq)]
pub enum Attribute {
    /// Text.
    Text(String),
    /// A list of texts.
    Texts(Vec<String>),
    /// A number.
    Number(f64),
    /// A whole number.
    Integer(i64),
}

impl From<&str> for Attribute {
    fn from(text: &str) -> Self {
        Self::Text(text.to_owned())
    }
}

/// A file that is being written.
#[derive(Debug)]
pub struct Writer<W> {
    sink: W,
    /// Bytes written so far.
    position: u64,
    objects: Vec<Object>,
}

#[derive(Debug)]
struct Object {
    /// Name within its group; empty for the root.
    name: String,
    attributes: Vec<(String, Attribute)>,
    kind: Kind,
}

#[derive(Debug)]
enum Kind {
    /// Members, in any order.
    Group(Vec<usize>),
    Dataset(Dataset),
}

#[derive(Debug)]
struct Dataset {
    kind: Type,
    shape: Vec<u64>,
    layout: Layout,
    /// The scale of each dimension, if it has any.
    scales: Vec<Option<usize>>,
    /// Datasets and their dimensions of which this one is the scale.
    scale_of: Vec<(usize, u32)>,
}

impl<W: Write + Seek> Writer<W> {
    /// Starts a file at the present position of `sink`, which must be its start.
    ///
    /// # Errors
    /// What the disk says.
    pub fn new(mut sink: W) -> io::Result<Self> {
        sink.write_all(&[0; SUPERBLOCK_SIZE as usize])?;
        Ok(Self {
            sink,
            position: SUPERBLOCK_SIZE,
            objects: vec![Object {
                name: String::new(),
                attributes: Vec::new(),
                kind: Kind::Group(Vec::new()),
            }],
        })
    }

    /// The root group.
    #[must_use]
    pub fn root(&self) -> Node {
        Node(0)
    }

    /// The group of this name in `parent`, made if it is not there.
    ///
    /// # Errors
    /// A dataset of that name is there.
    pub fn group(&mut self, parent: Node, name: &str) -> io::Result<Node> {
        match self.find(parent, name) {
            Some(index) if matches!(self.objects[index].kind, Kind::Group(_)) => Ok(Node(index)),
            Some(_) => Err(misuse(format!("{name} is a dataset"))),
            None => self.add(parent, name, Kind::Group(Vec::new())),
        }
    }

    /// Sets an attribute; one of the same name is replaced.
    pub fn set(&mut self, node: Node, name: &str, value: impl Into<Attribute>) {
        let attributes = &mut self.objects[node.0].attributes;
        attributes.retain(|(other, _)| other != name);
        attributes.push((name.to_owned(), value.into()));
    }

    /// A dataset of doubles; an empty shape is a scalar.
    ///
    /// # Errors
    /// Values that do not fill the shape, a name that is taken, what the disk says.
    pub fn doubles(
        &mut self,
        group: Node,
        name: &str,
        shape: &[usize],
        values: &[f64],
    ) -> io::Result<Node> {
        let bytes: Vec<u8> = values.iter().flat_map(|v| v.to_le_bytes()).collect();
        self.whole(group, name, Type::Double, shape, &bytes)
    }

    /// A dataset of 64-bit integers; an empty shape is a scalar.
    ///
    /// # Errors
    /// As [`Writer::doubles`].
    pub fn integers(
        &mut self,
        group: Node,
        name: &str,
        shape: &[usize],
        values: &[i64],
    ) -> io::Result<Node> {
        let bytes: Vec<u8> = values.iter().flat_map(|v| v.to_le_bytes()).collect();
        self.whole(group, name, Type::Integer, shape, &bytes)
    }

    /// A dataset of single-precision numbers that is taken row by row, a row being one index of its
    /// first dimension: `row` fills the given values of row `index`. A chunk is held at a time.
    ///
    /// # Errors
    /// What `row` says, and as [`Writer::doubles`].
    pub fn rows(
        &mut self,
        group: Node,
        name: &str,
        shape: &[usize],
        row: &mut dyn FnMut(usize, &mut [f32]) -> io::Result<()>,
    ) -> io::Result<Node> {
        let [rows, inner @ ..] = shape else {
            return Err(misuse(format!("{name} has no rows")));
        };
        let width: usize = inner.iter().product();
        if *rows == 0 || width == 0 {
            return Err(misuse(format!("{name} is empty")));
        }
        let per_chunk = (CHUNK_BYTES / (width * Type::Single.size())).clamp(1, *rows);
        let mut chunks = Vec::new();
        let mut values = vec![0.0; width];
        for first in (0..*rows).step_by(per_chunk) {
            let mut bytes = Vec::with_capacity(per_chunk * width * Type::Single.size());
            for index in first..(first + per_chunk).min(*rows) {
                row(index, &mut values)?;
                bytes.extend(values.iter().flat_map(|v| v.to_le_bytes()));
            }
            // The last chunk is as long as the others.
            bytes.resize(per_chunk * width * Type::Single.size(), 0);
            let mut offset = vec![0; shape.len()];
            offset[0] = first as u64;
            chunks.push(self.chunk(offset, &bytes, Type::Single.size())?);
        }
        let mut dims = vec![per_chunk];
        dims.extend(inner);
        self.chunked(group, name, Type::Single, shape, &dims, &chunks)
    }

    /// Makes `scale` the scale of a dimension of `dataset`.
    ///
    /// # Errors
    /// One of them is no dataset, or there is no such dimension.
    pub fn attach_scale(&mut self, dataset: Node, dimension: usize, scale: Node) -> io::Result<()> {
        let [Some(Kind::Dataset(_)), Some(Kind::Dataset(_))] =
            [dataset, scale].map(|node| self.objects.get(node.0).map(|object| &object.kind))
        else {
            return Err(misuse("only datasets have scales".to_owned()));
        };
        if let Kind::Dataset(data) = &mut self.objects[dataset.0].kind {
            let Some(slot) = data.scales.get_mut(dimension) else {
                return Err(misuse(format!("there is no dimension {dimension}")));
            };
            *slot = Some(scale.0);
        }
        let name = self.objects[scale.0].name.clone();
        self.set(scale, "CLASS", "DIMENSION_SCALE");
        self.set(scale, "NAME", Attribute::Text(name));
        if let Kind::Dataset(data) = &mut self.objects[scale.0].kind {
            data.scale_of.push((dataset.0, dimension as u32));
        }
        Ok(())
    }

    /// Writes what describes the data and gives the sink back. Without it there is no file.
    ///
    /// # Errors
    /// What the disk says, or a file beyond the bounds of this writer.
    pub fn finish(mut self) -> io::Result<W> {
        self.align()?;
        let heap = Heap::of(&self.objects, self.position)?;
        self.write(&heap.bytes(&[]))?;
        let plan = index::Plan::new(&self.objects, &heap, self.position)?;
        // The heap holds addresses of headers: only now are they known.
        self.sink.seek(SeekFrom::Start(heap.address()))?;
        self.sink.write_all(&heap.bytes(&plan.headers))?;
        self.sink.seek(SeekFrom::Start(self.position))?;
        let description = plan.bytes(&self.objects, &heap)?;
        self.write(&description)?;
        self.sink.seek(SeekFrom::Start(0))?;
        self.sink.write_all(&plan.superblock(self.position))?;
        self.sink.flush()?;
        Ok(self.sink)
    }

    fn find(&self, parent: Node, name: &str) -> Option<usize> {
        match &self.objects[parent.0].kind {
            Kind::Group(members) => members
                .iter()
                .copied()
                .find(|member| self.objects[*member].name == name),
            Kind::Dataset(_) => None,
        }
    }

    fn add(&mut self, parent: Node, name: &str, kind: Kind) -> io::Result<Node> {
        if name.is_empty() || name.contains(['/', '\0']) {
            return Err(misuse(format!("\"{name}\" is no name")));
        }
        if self.find(parent, name).is_some() {
            return Err(misuse(format!("{name} is there twice")));
        }
        let index = self.objects.len();
        match &mut self.objects[parent.0].kind {
            Kind::Group(members) => members.push(index),
            Kind::Dataset(_) => return Err(misuse(format!("{name} is not in a group"))),
        }
        self.objects.push(Object {
            name: name.to_owned(),
            attributes: Vec::new(),
            kind,
        });
        Ok(Node(index))
    }

    /// A dataset that is there as a whole.
    fn whole(
        &mut self,
        group: Node,
        name: &str,
        kind: Type,
        shape: &[usize],
        bytes: &[u8],
    ) -> io::Result<Node> {
        let values: usize = shape.iter().product();
        if bytes.len() != values * kind.size() || values == 0 {
            return Err(misuse(format!("{name} does not fill its shape {shape:?}")));
        }
        if values >= FEWEST_CHUNKED {
            let chunk = self.chunk(vec![0; shape.len()], bytes, kind.size())?;
            return self.chunked(group, name, kind, shape, shape, &[chunk]);
        }
        self.align()?;
        let layout = Layout::Contiguous {
            address: self.position,
            size: bytes.len() as u64,
        };
        self.write(bytes)?;
        self.dataset(group, name, kind, shape, layout)
    }

    fn chunked(
        &mut self,
        group: Node,
        name: &str,
        kind: Type,
        shape: &[usize],
        chunk: &[usize],
        chunks: &[Chunk],
    ) -> io::Result<Node> {
        let dims: Vec<u32> = chunk
            .iter()
            .map(|n| u32::try_from(*n).map_err(|_| misuse(format!("{name} is too wide"))))
            .collect::<io::Result<_>>()?;
        self.align()?;
        let (tree, address) = index::chunk_tree(chunks, &dims, self.position);
        self.write(&tree)?;
        let layout = Layout::Chunked { address, dims };
        self.dataset(group, name, kind, shape, layout)
    }

    fn dataset(
        &mut self,
        group: Node,
        name: &str,
        kind: Type,
        shape: &[usize],
        layout: Layout,
    ) -> io::Result<Node> {
        let dataset = Dataset {
            kind,
            shape: shape.iter().map(|n| *n as u64).collect(),
            layout,
            scales: vec![None; shape.len()],
            scale_of: Vec::new(),
        };
        self.add(group, name, Kind::Dataset(dataset))
    }

    /// Writes one chunk, shuffled and deflated.
    fn chunk(&mut self, offset: Vec<u64>, bytes: &[u8], element: usize) -> io::Result<Chunk> {
        let mut encoder = ZlibEncoder::new(Vec::new(), Compression::new(encode::DEFLATE_LEVEL));
        encoder.write_all(&shuffle(bytes, element))?;
        let packed = encoder.finish()?;
        let chunk = Chunk {
            offset,
            address: self.position,
            size: u32::try_from(packed.len()).map_err(|_| misuse("a chunk is too large".into()))?,
        };
        self.write(&packed)?;
        Ok(chunk)
    }

    fn align(&mut self) -> io::Result<()> {
        let padding = self.position.next_multiple_of(8) - self.position;
        self.write(&vec![0; padding as usize])
    }

    fn write(&mut self, bytes: &[u8]) -> io::Result<()> {
        self.sink.write_all(bytes)?;
        self.position += bytes.len() as u64;
        Ok(())
    }
}

/// First the first bytes of all elements, then the second ones and so on: alike bytes stand together
/// and deflate better.
fn shuffle(bytes: &[u8], element: usize) -> Vec<u8> {
    (0..element)
        .flat_map(|byte| bytes.iter().skip(byte).step_by(element).copied())
        .collect()
}

fn misuse(reason: String) -> io::Error {
    io::Error::new(io::ErrorKind::InvalidInput, format!("HDF5: {reason}"))
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "a test may stop at the first surprise")]
mod tests {
    use super::*;
    use std::io::Cursor;

    #[test]
    fn shuffled_bytes_stand_by_place() {
        assert_eq!(shuffle(&[1, 2, 3, 4, 5, 6], 2), [1, 3, 5, 2, 4, 6]);
    }

    #[test]
    fn misuse_is_refused() {
        let mut file = Writer::new(Cursor::new(Vec::new())).unwrap();
        let root = file.root();
        let data = file.doubles(root, "a", &[2], &[1.0, 2.0]).unwrap();
        assert!(file.doubles(root, "a", &[1], &[1.0]).is_err());
        assert!(file.doubles(root, "b", &[3], &[1.0]).is_err());
        assert!(file.doubles(root, "b/c", &[1], &[1.0]).is_err());
        assert!(file.doubles(data, "b", &[1], &[1.0]).is_err());
        assert!(file.group(root, "a").is_err());
        assert!(file.attach_scale(data, 1, data).is_err());
        assert!(file.attach_scale(data, 0, root).is_err());
    }

    #[test]
    fn the_superblock_knows_the_length() {
        let mut file = Writer::new(Cursor::new(Vec::new())).unwrap();
        let root = file.root();
        file.doubles(root, "a", &[1000], &[1.5; 1000]).unwrap();
        file.set(root, "title", "x");
        let bytes = file.finish().unwrap().into_inner();
        assert_eq!(bytes[..8], *b"\x89HDF\r\n\x1a\n");
        assert_eq!(bytes[40..48], (bytes.len() as u64).to_le_bytes());
    }

    /// Memory holds a chunk, however many rows there are: no piece that is written is longer.
    #[test]
    fn rows_are_written_as_they_come() {
        struct Watched(Cursor<Vec<u8>>, usize);
        impl Write for Watched {
            fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
                self.1 = self.1.max(bytes.len());
                self.0.write(bytes)
            }
            fn flush(&mut self) -> io::Result<()> {
                Ok(())
            }
        }
        impl Seek for Watched {
            fn seek(&mut self, to: SeekFrom) -> io::Result<u64> {
                self.0.seek(to)
            }
        }
        let longest = |rows: usize| {
            let mut file = Writer::new(Watched(Cursor::new(Vec::new()), 0)).unwrap();
            let root = file.root();
            let mut noise = 1_u32;
            let mut row = |_: usize, values: &mut [f32]| {
                for value in values {
                    // Xorshift: nothing that deflates.
                    noise ^= noise << 13;
                    noise ^= noise >> 17;
                    noise ^= noise << 5;
                    *value = f32::from_bits(noise);
                }
                Ok(())
            };
            file.rows(root, "a", &[rows, 64, 32], &mut row).unwrap();
            let sink = file.finish().unwrap();
            assert!(sink.0.into_inner().len() > rows * 64 * 32 * 3);
            sink.1
        };
        let bar = CHUNK_BYTES + CHUNK_BYTES / 100;
        assert!(longest(100) <= bar && longest(800) <= bar);
    }
}
